// Seeded random use of the whole program: nothing breaks, memory stays flat, and the journal holds what is
// shown. PATCHLAB_SOAK sets how many actions are tried. Every 25th handful is drawn.
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <vector>

#include "engine/patch/marginals.h"
#include "tests/support/seeded_random.h"
#include "tests/viewer/app/ball_scan.h"
#include "tests/viewer/app/program.h"

namespace patchlab::viewer {
namespace {

// Whoever opens, saves or exports meets a file dialog, from where random input would reach any file. By way
// of menus it may still be met, and is left.
bool leads_to_files(Action action) {
  return action == Action::open_file || action == Action::save_journal_as ||
         action == Action::export_patches || action == Action::save_picture || action == Action::palette ||
         action == Action::quit;
}
bool leads_to_files(const std::string& widget) { return widget == "menu/File" || widget == "inspector/open"; }

class Monkey {
 public:
  Monkey(Program& program, Random& random) : program_(program), random_(random) {}

  // A line or more of an input log.
  std::string next() {
    const double what = random_.uniform(0.0, 1.0);
    for (const char* sheet : {"help/close", "messages/close", "files/path"}) {
      if (program_.app().widgets().contains(sheet)) return "key Esc\n";
    }
    // Its rows lead to files too.
    if (program_.app().widgets().contains("palette/text")) return "key Esc\n";
    if (what < 0.12) return "key L\ndrag " + around_the_middle() + "wait\n";
    if (what < 0.16) return "key G\nclick " + any_place() + "\nwait\n";
    if (what < 0.24) return "key Enter\nwait\n";
    if (what < 0.40) return "key " + any_key() + "\n";
    if (what < 0.55) return "click " + any_widget() + "\n";
    if (what < 0.67) return "click " + any_place() + "\n";
    if (what < 0.80) return "drag " + any_place() + any_place() + any_place() + any_place() + "\n";
    if (what < 0.85) return "wheel " + std::to_string(below(7) - 3) + "\n";
    if (what < 0.90) return "type q2\n";
    return "wait\n";
  }

 private:
  int below(int end) { return static_cast<int>(random_.uniform(0.0, end - 1e-9)); }
  std::string any_key() {
    for (;;) {
      const auto actions = action_table();
      const ActionRow& action = actions[static_cast<std::size_t>(below(static_cast<int>(actions.size())))];
      if (action.key != 0 && !leads_to_files(action.action)) return key_name(action);
    }
  }
  std::string any_widget() {
    const WidgetMap& widgets = program_.app().widgets();
    for (;;) {
      const auto widget = std::next(widgets.begin(), below(static_cast<int>(widgets.size())));
      if (leads_to_files(widget->first)) continue;
      const Rect& rect = widget->second;
      return place(rect.x + rect.width / 2, rect.y + rect.height / 2);
    }
  }
  // Most often near the ball, which is in the middle at first.
  std::string any_place() {
    const Rect view = program_.app().layout().view;
    const double spread = random_.uniform(0.0, 1.0) < 0.7 ? 0.12 : 0.5;
    return place(view.x + view.width * (0.5f + static_cast<float>(random_.uniform(-spread, spread))),
                 view.y + view.height * (0.5f + static_cast<float>(random_.uniform(-spread, spread))));
  }
  std::string around_the_middle() {
    const double radius = random_.uniform(0.03, 0.07);
    std::string places;
    for (const double turn : {0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0})
      places += program_.at(radius * std::cos(turn), radius * std::sin(turn));
    return places + "\n";
  }
  static std::string place(float x, float y) { return std::to_string(x) + " " + std::to_string(y) + " "; }

  Program& program_;
  Random& random_;
};

std::string fingerprint(const Document& document) {
  std::string text;
  const auto add = [&text](const auto& entry) {
    text += entry.id + "|" + entry.name + (entry.visible ? "|" : "|hidden|");
  };
  for (const ScanEntry& scan : document.scans) {
    add(scan);
    text += scan.noise.specification + "\n";
  }
  for (const RegionEntry& region : document.regions) {
    add(region);
    for (const std::uint32_t id : *region.points) text += std::to_string(id) + " ";
    text += std::to_string(region.hidden_left_out) + "\n";
  }
  for (const PatchEntry& patch : document.patches) {
    add(patch);
    text += result_hash(*patch.fit) + "\n";
  }
  return text;
}

extern "C" std::size_t __sanitizer_get_current_allocated_bytes() __attribute__((weak));

// Of the heap, in use.
double megabytes() {
  const std::size_t bytes = __sanitizer_get_current_allocated_bytes
                                ? __sanitizer_get_current_allocated_bytes()
                                : mallinfo2().uordblks;
  return 1e-6 * static_cast<double>(bytes);
}

class Soak : public testing::Test {
 protected:
  static constexpr int together = 4, a_sitting = 500, drawn_one_in = 25;

  void SetUp() override {
    program.app().open(folder.ball(4));
    program.settle();
    program.app().workbench().save_journal(start);
    program.settle();
  }

  // What failed can be opened.
  void TearDown() override {
    if (HasFailure())
      std::filesystem::copy(folder.path(), "soak_failed", std::filesystem::copy_options::recursive);
  }

  // From the start of a journal to its end.
  void sit(int actions) {
    program.app().open(start);
    program.settle();
    Monkey monkey(program, random);
    for (int done = 0; done < actions; done += together) {
      std::string log;
      for (int i = 0; i < together; ++i) log += monkey.next();
      SCOPED_TRACE(log);
      said << log << std::flush;
      program.set_drawing(done / together % drawn_one_in == 0);
      program.play(log);
      expect_sound_patches();
      if (HasFatalFailure()) return;
    }
    program.play("key Esc\nkey Esc\nkey Esc\nwait\n");
    expect_journal_of_what_is_shown();
  }

  void expect_sound_patches() {
    for (const PatchEntry& entry : program.document().patches) {
      if (!entry.fit) continue;
      const Patch& patch = entry.fit->patch;
      const Result<void> valid = validate(patch);
      ASSERT_TRUE(valid) << entry.name << ": " << valid.error().message;
      for (const Vector2d& u : outline(boundary(patch), 16))
        ASSERT_TRUE(std::isfinite(height_sigma(patch, u)))
            << name(patch.type->surface) << " " << patch.parameters;
    }
  }
  void expect_journal_of_what_is_shown() {
    const Session& session = program.app().workbench().session();
    const Result<Document> replayed = replay(session.journal());
    ASSERT_TRUE(replayed) << replayed.error().message;
    EXPECT_EQ(fingerprint(*replayed), fingerprint(session.document()));
    for (const Error& error : program.app().errors())
      ASSERT_NE(error.code, ErrorCode::unwritable) << error.message;
    steps += session.history().size();
  }

  test::SeededRandom random;
  std::ofstream said{"soak.log"};  // all that was done, also where the program ends
  const TestFolder folder;
  const std::filesystem::path start = folder.path() / "start.patchlab";
  Program program{folder.path() / "state", {1.0f, ThemeChoice::dark}, 800, 500};
  std::size_t steps = 0;
};

TEST_F(Soak, RandomUseBreaksNothingAndTheJournalHoldsWhatIsShown) {
  const char* wanted = std::getenv("PATCHLAB_SOAK");
  const int actions = wanted ? std::atoi(wanted) : 24;
  std::vector<double> in_use;  // MB, where each sitting but the first starts
  for (int done = 0; done < actions && !HasFatalFailure(); done += a_sitting) {
    if (done > 0) {
      program.app().open(start);
      program.settle();
      in_use.push_back(megabytes());
      std::cout << done << " actions, " << steps << " steps, " << program.app().errors().size()
                << " errors told, " << in_use.back() << " MB in use" << std::endl;
    }
    sit(std::min(a_sitting, actions - done));
  }
  // The second half of them holds no more than the first, but for what is said and never forgotten.
  const auto middle = in_use.begin() + static_cast<std::ptrdiff_t>(in_use.size() / 2);
  if (in_use.size() >= 4) {
    EXPECT_LE(*std::max_element(middle, in_use.end()), *std::max_element(in_use.begin(), middle) + 2.0);
  }
}

}  // namespace
}  // namespace patchlab::viewer
