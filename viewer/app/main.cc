#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>

#include "engine/base/file.h"
#include "viewer/app/app.h"
#include "viewer/app/headless.h"
#include "viewer/app/journal_file.h"
#include "viewer/app/options.h"
#include "viewer/app/settings.h"

namespace patchlab::viewer {

namespace {

int fail(const Error& error) {
  std::fprintf(stderr, "patchlab-viewer: %s\n", error.message.c_str());
  return exit_status(error.code);
}

Result<void> play_log(const std::filesystem::path& file, App& app, Platform& platform) {
  const Result<Bytes> bytes = read_file(file);
  if (!bytes) return bytes.error();
  const Result<std::vector<LogEvent>> events = parse_input_log(as_text(*bytes), file.string());
  if (!events) return events.error();
  return play(*events, app, platform);
}

Result<void> export_all(const ViewerOptions& options, App& app) {
  for (const ExportRequest& request : options.exports) {
    const Result<void> written =
        export_patches(app.workbench().session().document(), app.workbench().journal(), request);
    if (!written) return written;
  }
  return {};
}

int run_without_user(const ViewerOptions& options, App& app, Platform& platform) {
  run_until_settled(app, platform);
  if (options.replay) {
    if (const Result<void> played = play_log(*options.replay, app, platform); !played)
      return fail(played.error());
    run_until_settled(app, platform);
  }
  if (options.screenshot) {
    app.clear_notices();
    const Image image = app.picture(
        {platform.width(), platform.height(), platform.scale(), options.view_alone, options.transparent});
    if (const Result<void> written = write_png(*options.screenshot, image); !written) {
      return fail(written.error());
    }
  }
  if (const Result<void> written = export_all(options, app); !written) return fail(written.error());
  int status = 0;
  for (const Error& error : app.errors()) status = std::max(status, fail(error));
  return status;
}

// What is waited before each of the frames after input, s: ImGui lays out over several of them what it
// changed; the later ones show what the earlier took without notice.
constexpr std::array waits_after_input = {0.0, 0.0, 0.0, 0.05, 0.3};

// Waits at most so many seconds; whether something ended that early.
bool something_came(Platform& platform, double patience) {
  const auto start = std::chrono::steady_clock::now();
  platform.wait_events(patience);
  const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - start;
  return waited.count() < 0.9 * patience;
}

// Settings that cannot be written are not worth a word: the work itself is in the journal.
int run_window(App& app, Platform& platform, const std::filesystem::path& settings_file) {
  Settings written = app.settings();
  std::size_t quiet = 0;  // frames since the last input
  while (!platform.should_close() && !app.wants_to_close()) {
    const bool resting = quiet == waits_after_input.size();
    const bool came = something_came(platform, resting ? app.patience() : waits_after_input[quiet]);
    if (came) quiet = 0;
    if (!came && !resting) ++quiet;
    app.frame();
    if (app.settings() == written) continue;
    written = app.settings();
    (void)write_settings(settings_file, written).ok();
  }
  return 0;
}

// What a window is like at first: as it was left, unless the command line says otherwise.
Settings settings_for(const ViewerOptions& options, bool without_user) {
  Settings settings = without_user ? Settings() : read_settings(default_settings_file());
  if (options.theme) settings.theme = *options.theme;
  if (options.scale > 0) settings.scale = options.scale;
  return settings;
}

int run(const ViewerOptions& options) {
  const bool without_user = options.headless || options.screenshot;
  const Settings settings = settings_for(options, without_user);
  const Result<std::unique_ptr<Platform>> platform =
      make_platform({"patchlab", options.width, options.height, options.headless, settings.scale});
  if (!platform) return fail(platform.error());
  Result<Renderer> renderer = Renderer::create();
  if (!renderer) return fail(renderer.error());
  // A picture of a journal leaves the journal as it is.
  const bool keeps_journals = !options.headless || options.replay;
  App app(**platform, std::move(*renderer),
          {settings, default_journal_folder(), keeps_journals, !without_user || options.replay.has_value()});
  for (const std::filesystem::path& file : options.files) app.open(file);
  if (without_user) return run_without_user(options, app, **platform);
  return run_window(app, **platform, default_settings_file());
}

}  // namespace

}  // namespace patchlab::viewer

int main(int argc, char** argv) {
  using namespace patchlab::viewer;
  const std::variant<ViewerOptions, Exit> parsed = parse_options(argc, argv);
  if (const Exit* exit = std::get_if<Exit>(&parsed)) {
    std::fputs(exit->text.c_str(), exit->status == 0 ? stdout : stderr);
    return exit->status;
  }
  return run(std::get<ViewerOptions>(parsed));
}
