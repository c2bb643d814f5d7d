// Seeded random use of the whole program: nothing breaks, and the journal holds what is shown.
// PATCHLAB_SOAK sets how many actions are tried.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <iostream>

#include "tests/support/seeded_random.h"
#include "tests/viewer/app/ball_scan.h"
#include "tests/viewer/app/program.h"

namespace patchlab::viewer {
namespace {

// Whoever opens, saves or exports meets a file dialog, from where random input would reach any file.
bool leads_to_files(Action action) {
  return action == Action::open_file || action == Action::save_journal_as ||
         action == Action::export_patches || action == Action::save_picture || action == Action::quit;
}
bool leads_to_files(const std::string& widget) { return widget == "menu/File" || widget == "inspector/open"; }

class Monkey {
 public:
  Monkey(Program& program, Random& random) : program_(program), random_(random) {}

  // A line or more of an input log.
  std::string next() {
    const double what = random_.uniform(0.0, 1.0);
    for (const char* sheet : {"help/close", "messages/close"}) {
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

TEST(Soak, RandomUseBreaksNothingAndTheJournalHoldsWhatIsShown) {
  const char* wanted = std::getenv("PATCHLAB_SOAK");
  const int actions = wanted ? std::atoi(wanted) : 24;
  constexpr int together = 4;
  test::SeededRandom random;
  const TestFolder folder;
  Program program(folder.path() / "state", {1.0f, ThemeChoice::dark}, 960, 600);
  program.app().open(folder.ball());
  program.settle();
  Monkey monkey(program, random);
  for (int done = 0; done < actions; done += together) {
    std::string log;
    for (int i = 0; i < together; ++i) log += monkey.next();
    SCOPED_TRACE(log);
    program.play(log);
    ASSERT_FALSE(program.app().widgets().contains("files/path")) << "random input must not reach files";
  }
  program.play("key Esc\nkey Esc\nkey Esc\nwait\n");
  const Session& session = program.app().workbench().session();
  const Result<Document> replayed = replay(session.journal());
  ASSERT_TRUE(replayed) << replayed.error().message;
  EXPECT_EQ(fingerprint(*replayed), fingerprint(session.document()));
  std::cout << session.history().size() << " steps, " << program.app().errors().size() << " errors told\n";
  for (const Error& error : program.app().errors())
    EXPECT_NE(error.code, ErrorCode::unwritable) << error.message;
}

}  // namespace
}  // namespace patchlab::viewer
