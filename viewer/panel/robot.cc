// The inspector of a robot: its joints as sliders, and where it stands.
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "viewer/panel/colours.h"
#include "viewer/panel/numbers.h"
#include "viewer/panel/panels.h"

namespace patchlab::viewer {

namespace {

constexpr double free_turn = std::numbers::pi;  // rad, each way, of a joint without limits
constexpr double degrees = 180.0 / std::numbers::pi;

JointLimits range_of(const RobotJoint& joint) {
  return joint.limits.value_or(JointLimits{-free_turn, free_turn});
}

std::string joint_words(const RobotJoint& joint, double value) {
  return joint.kind == JointKind::sliding ? quantity(value, Dimension::length, 3)
                                          : fixed(value * degrees, 1) + "°";
}

std::string joint_sigma_words(const RobotJoint& joint, double sigma) {
  if (sigma == 0.0) return "exact";
  return sigma_text(sigma, joint.kind == JointKind::sliding ? Dimension::length : Dimension::angle);
}

// "left_hip_yaw" reads "left hip yaw".
std::string spoken(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

void draw_joint(const PanelInput& in, const RobotEntry& robot, const RobotJoint& joint, PanelMemory& memory,
                Requests& out) {
  const Gui& gui = in.gui;
  const JointValue now = robot.joints.at(joint.name);
  const JointLimits range = range_of(joint);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw_text(draw, gui.fonts.body, at, gui.theme.text_dim,
            fit_text(gui.fonts.body, spoken(joint.name), width * 0.5f));
  draw_text_right(draw, gui.fonts.body, {at.x + width * 0.72f, at.y}, gui.theme.text,
                  joint_words(joint, now.value));
  draw_text_right(draw, gui.fonts.body, {at.x + width, at.y}, gui.theme.text_dim,
                  joint_sigma_words(joint, now.sigma));
  ImGui::Dummy({width, gui.fonts.body->FontSize});
  double part = std::clamp((now.value - range.lower) / (range.upper - range.lower), 0.0, 1.0);
  const bool held = slider(gui, ("joints/" + joint.name).c_str(), part);
  if (held) {
    out.drag_joint = SetJoint{robot.id, joint.name, range.lower + part * (range.upper - range.lower), {}};
    memory.held_joint = joint.name;
  } else if (memory.held_joint == joint.name) {
    out.commands.push_back(SetJoint{robot.id, joint.name, now.value, {}});
    memory.held_joint.clear();
  }
  tooltip(gui, held ? "" : joint_words(joint, range.lower) + " to " + joint_words(joint, range.upper));
}

struct PlaceValues {
  double xyz[3], turn[3];   // m; roll, pitch, yaw, degrees
  double sigma_t, sigma_r;  // mm, mrad
};

// Roll, pitch and yaw about fixed axes, as in a URDF.
PlaceValues values_of(const UncertainPose& pose) {
  const Matrix3d R = exp_map(pose.pose.r);
  PlaceValues values{};
  for (int i = 0; i < 3; ++i) values.xyz[i] = pose.pose.t[i];
  values.turn[0] = std::atan2(R(2, 1), R(2, 2)) * degrees;
  values.turn[1] = std::atan2(-R(2, 0), std::hypot(R(2, 1), R(2, 2))) * degrees;
  values.turn[2] = std::atan2(R(1, 0), R(0, 0)) * degrees;
  values.sigma_r = std::sqrt(pose.covariance(0, 0)) * 1e3;
  values.sigma_t = std::sqrt(pose.covariance(3, 3)) * 1e3;
  return values;
}

UncertainPose pose_of(const PlaceValues& values) {
  const Matrix3d R = exp_map({0, 0, values.turn[2] / degrees}) * exp_map({0, values.turn[1] / degrees, 0}) *
                     exp_map({values.turn[0] / degrees, 0, 0});
  UncertainPose pose;
  pose.pose = {log_map(R), {values.xyz[0], values.xyz[1], values.xyz[2]}};
  pose.covariance.diagonal().head<3>().setConstant(std::pow(values.sigma_r * 1e-3, 2));
  pose.covariance.diagonal().tail<3>().setConstant(std::pow(values.sigma_t * 1e-3, 2));
  return pose;
}

struct NumberField {
  const char *name, *unit;
  double* value;
};
// To type over; true when another number was entered.
bool draw_field(const Gui& gui, const NumberField& field, ImVec2 at, float width) {
  const float name_width = gui.px(50);
  draw_text(*ImGui::GetWindowDrawList(), gui.fonts.body, {at.x, at.y + gui.px(5)}, gui.theme.text_dim,
            field.name);
  ImGui::SetCursorScreenPos({at.x + name_width, at.y});
  ImGui::SetNextItemWidth(width - name_width);
  const std::string format = std::string("%.4g ") + field.unit;
  ImGui::InputDouble((std::string("##") + field.name).c_str(), field.value, 0.0, 0.0, format.c_str(),
                     ImGuiInputTextFlags_AutoSelectAll);
  gui.note(std::string("place/") + field.name);
  return ImGui::IsItemDeactivatedAfterEdit();
}

bool draw_fields(const Gui& gui, PlaceValues& values) {
  const NumberField rows[][2] = {{{"x", "m", &values.xyz[0]}, {"roll", "°", &values.turn[0]}},
                                 {{"y", "m", &values.xyz[1]}, {"pitch", "°", &values.turn[1]}},
                                 {{"z", "m", &values.xyz[2]}, {"yaw", "°", &values.turn[2]}},
                                 {{"σ", "mm", &values.sigma_t}, {"σ turn", "mrad", &values.sigma_r}}};
  const float gap = gui.px(14), width = (ImGui::GetContentRegionAvail().x - gap) / 2;
  const float height = gui.fonts.body->FontSize + gui.px(14);
  bool entered = false;
  for (const auto& row : rows) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    for (const int column : {0, 1}) {
      const float x = at.x + static_cast<float>(column) * (width + gap);
      if (draw_field(gui, row[column], {x, at.y}, width)) entered = true;
    }
    ImGui::SetCursorScreenPos({at.x, at.y + height});
  }
  return entered;
}

}  // namespace

void draw_place(const PanelInput& in, const std::string& frame, Requests& out) {
  const Gui& gui = in.gui;
  const std::string shown = shown_frame(in.document);
  if (frame == shown) return;
  section(gui, "PLACE", "of " + frame + " in " + shown);
  const Result<UncertainPose> pose = pose_between(in.document, shown, frame);
  if (!pose) {
    paragraph(gui, gui.theme.doubt_text,
              "Nothing says yet where " + frame + " stands in " + shown + "; it is drawn at its origin.");
  }
  PlaceValues values = values_of(pose ? *pose : UncertainPose{});
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {gui.px(8), gui.px(5)});
  const bool entered = draw_fields(gui, values);
  ImGui::PopStyleVar();
  if (!entered) return;
  values.sigma_t = std::max(values.sigma_t, 0.0);
  values.sigma_r = std::max(values.sigma_r, 0.0);
  out.commands.push_back(Place{frame, shown, pose_of(values)});
}

void draw_robot(const PanelInput& in, const RobotEntry& robot, PanelMemory& memory, Requests& out) {
  const Gui& gui = in.gui;
  draw_title(gui, robot.name, "robot");
  const Robot& model = robot.model->robot;
  fact(gui, "links", count(model.links.size()));
  fact(gui, "patches", count(robot.model->patches.size()));
  fact(gui, "base", model.base + (robot.frame == model.base ? "" : ", fixed in " + robot.frame));
  draw_place(in, robot.frame, out);
  section(gui, "JOINTS", "drag; σ at the right");
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {gui.px(8), gui.px(2)});
  for (const RobotJoint& joint : model.joints) {
    if (robot.joints.contains(joint.name)) draw_joint(in, robot, joint, memory, out);
  }
  ImGui::PopStyleVar();
  if (!robot.model->notices.empty()) section(gui, "NOTICES");
  for (const std::string& notice : robot.model->notices) paragraph(gui, gui.theme.text, notice);
}

}  // namespace patchlab::viewer
