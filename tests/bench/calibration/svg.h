// Plots as SVG text: dark marks on a white sheet of their own, so that they read on dark pages too.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace patchlab::calibration {

struct Point {
  double x, y;  // px, y down
};

namespace colour {  // Okabe and Ito, told apart by the colour-blind
inline constexpr std::string_view ink = "#222222", faint = "#6b6b6b", rule = "#d9d9d9", band = "#e3e3e3",
                                  blue = "#0072B2", vermillion = "#D55E00";
}

enum class Anchor { start, middle, end };

struct TextStyle {
  double size = 13.0;  // px
  Anchor anchor = Anchor::start;
  std::string_view fill = colour::ink;
  bool bold = false;
  bool upwards = false;  // turned by a quarter, reading from the bottom up
};

// Values to pixels, linear.
struct Scale {
  double from, to;              // values
  double pixel_from, pixel_to;  // px
  double operator()(double value) const {
    return pixel_from + (value - from) / (to - from) * (pixel_to - pixel_from);
  }
};

class Svg {
 public:
  Svg(double width, double height, std::string_view title);

  void line(Point a, Point b, std::string_view stroke, double width = 1.0, std::string_view dashes = "");
  void polyline(const std::vector<Point>& points, std::string_view stroke, double width);
  void area(const std::vector<Point>& points, std::string_view fill);
  void box(Point corner, double width, double height, std::string_view fill);
  void dot(Point centre, double radius, std::string_view fill);
  void text(Point at, std::string_view words, const TextStyle& style = {});

  std::string finished() const { return body_ + "</svg>\n"; }

 private:
  std::string body_;
};

}  // namespace patchlab::calibration
