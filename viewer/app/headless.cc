#include "viewer/app/headless.h"

#include <chrono>
#include <thread>

namespace patchlab::viewer {

namespace {

// ImGui lays popups out over several frames.
constexpr int frames_to_rest = 3;

class Player {
 public:
  Player(App& app, Platform& platform) : app_(app), platform_(platform) {}

  Result<void> play(const LogEvent& event) {
    using Kind = LogEvent::Kind;
    switch (event.kind) {
      case Kind::click_widget:
        return click_widget(event);
      case Kind::click:
        click(event.places.front());
        break;
      case Kind::move:
        move(event.places.front());
        break;
      case Kind::press:
        button(event.button, true);
        break;
      case Kind::release:
        button(event.button, false);
        break;
      case Kind::drag:
        drag(event.places);
        break;
      case Kind::wheel:
        wheel(event.notches);
        break;
      case Kind::key:
        key(event.keys);
        break;
      case Kind::hold:
        hold(event.keys);
        break;
      case Kind::type:
        type(event.text);
        break;
      case Kind::wait:
        run_until_settled(app_, platform_);
        break;
    }
    return {};
  }

 private:
  void frame() {
    platform_.feed(input_);
    app_.frame();
  }
  void move(const Eigen::Vector2f& place) {
    input_.mouse_x = place.x();
    input_.mouse_y = place.y();
    frame();
  }
  void button(int which, bool down) {
    input_.buttons[static_cast<std::size_t>(which)] = down;
    frame();
  }
  void click(const Eigen::Vector2f& place) {
    move(place);
    button(0, true);
    button(0, false);
  }
  Result<void> click_widget(const LogEvent& event) {
    app_.frame();
    const auto widget = app_.widgets().find(event.text);
    if (widget == app_.widgets().end()) {
      return Error{ErrorCode::unreadable, "Line " + std::to_string(event.line) +
                                              " of the input log: there is no \"" + event.text +
                                              "\" on the screen."};
    }
    const Rect& rect = widget->second;
    click({rect.x + rect.width / 2, rect.y + rect.height / 2});
    return {};
  }
  void drag(const std::vector<Eigen::Vector2f>& places) {
    move(places.front());
    button(0, true);
    for (const Eigen::Vector2f& place : places) move(place);
    button(0, false);
  }
  void wheel(float notches) {
    input_.wheel = notches;
    frame();
    input_.wheel = 0;
    frame();
  }
  void key(const std::vector<int>& keys) {
    const std::set<int> held = input_.keys;
    input_.keys.insert(keys.begin(), keys.end());
    frame();
    input_.keys = held;
    frame();
  }
  void hold(const std::vector<int>& keys) {
    input_.keys = {keys.begin(), keys.end()};
    frame();
  }
  void type(const std::string& text) {
    input_.text = text;
    frame();
    input_.text.clear();
    frame();
  }

  App& app_;
  Platform& platform_;
  Input input_;
};

}  // namespace

void run_until_settled(App& app, Platform& platform) {
  int rested = 0;
  while (rested < frames_to_rest) {
    platform.wait_events(0);
    app.frame();
    rested = app.settled() ? rested + 1 : 0;
    if (!app.workbench().idle()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

Result<void> play(const std::vector<LogEvent>& events, App& app, Platform& platform) {
  Player player(app, platform);
  for (const LogEvent& event : events) {
    if (const Result<void> done = player.play(event); !done) return done;
  }
  return {};
}

}  // namespace patchlab::viewer
