#include "tests/bench/calibration/svg.h"

#include <cstdio>

namespace patchlab::calibration {
namespace {

std::string px(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

std::string attribute(std::string_view name, std::string_view value) {
  std::string text = " ";
  text.append(name).append("=\"").append(value).append("\"");
  return text;
}

std::string escaped(std::string_view words) {
  std::string text;
  for (const char c : words) {
    if (c == '&') {
      text += "&amp;";
    } else if (c == '<') {
      text += "&lt;";
    } else {
      text += c;
    }
  }
  return text;
}

std::string listed(const std::vector<Point>& points) {
  std::string text;
  for (const Point& p : points)
    text.append(text.empty() ? "" : " ").append(px(p.x)).append(",").append(px(p.y));
  return text;
}

std::string_view name(Anchor anchor) {
  switch (anchor) {
    case Anchor::start:
      return "start";
    case Anchor::middle:
      return "middle";
    case Anchor::end:
      return "end";
  }
  return "start";
}

}  // namespace

Svg::Svg(double width, double height, std::string_view title) {
  body_ = "<svg" + attribute("xmlns", "http://www.w3.org/2000/svg") +
          attribute("viewBox", "0 0 " + px(width) + " " + px(height)) + attribute("width", px(width)) +
          attribute("height", px(height)) +
          attribute("font-family", "Inter, Helvetica, Arial, 'DejaVu Sans', sans-serif") + ">\n<title>" +
          escaped(title) + "</title>\n<rect" + attribute("width", "100%") + attribute("height", "100%") +
          attribute("rx", "8") + attribute("fill", "#ffffff") + "/>\n";
}

void Svg::line(Point a, Point b, std::string_view stroke, double width, std::string_view dashes) {
  body_ += "<line" + attribute("x1", px(a.x)) + attribute("y1", px(a.y)) + attribute("x2", px(b.x)) +
           attribute("y2", px(b.y)) + attribute("stroke", stroke) + attribute("stroke-width", px(width)) +
           (dashes.empty() ? "" : attribute("stroke-dasharray", dashes)) + "/>\n";
}

void Svg::polyline(const std::vector<Point>& points, std::string_view stroke, double width) {
  body_ += "<polyline" + attribute("points", listed(points)) + attribute("fill", "none") +
           attribute("stroke", stroke) + attribute("stroke-width", px(width)) +
           attribute("stroke-linejoin", "round") + "/>\n";
}

void Svg::area(const std::vector<Point>& points, std::string_view fill) {
  body_ += "<polygon" + attribute("points", listed(points)) + attribute("fill", fill) + "/>\n";
}

void Svg::box(Point corner, double width, double height, std::string_view fill) {
  body_ += "<rect" + attribute("x", px(corner.x)) + attribute("y", px(corner.y)) +
           attribute("width", px(width)) + attribute("height", px(height)) + attribute("fill", fill) + "/>\n";
}

void Svg::dot(Point centre, double radius, std::string_view fill) {
  body_ += "<circle" + attribute("cx", px(centre.x)) + attribute("cy", px(centre.y)) +
           attribute("r", px(radius)) + attribute("fill", fill) + "/>\n";
}

void Svg::text(Point at, std::string_view words, const TextStyle& style) {
  body_ += "<text" + attribute("x", px(at.x)) + attribute("y", px(at.y)) +
           attribute("font-size", px(style.size)) + attribute("text-anchor", name(style.anchor)) +
           attribute("fill", style.fill) + (style.bold ? attribute("font-weight", "600") : "") +
           (style.upwards ? attribute("transform", "rotate(-90 " + px(at.x) + " " + px(at.y) + ")") : "") +
           ">" + escaped(words) + "</text>\n";
}

}  // namespace patchlab::calibration
