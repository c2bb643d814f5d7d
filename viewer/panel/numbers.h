// Numbers as people read them: a unit that fits, digits by the standard deviation, a true minus sign, counts
// in threes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace patchlab::viewer {

enum class Dimension { length, curvature, angle };

struct Measured {
  std::string value;  // "61.20 mm"
  std::string sigma;  // "± 0.21 mm"
};
// SI value and standard deviation. The value is given to the second digit of its standard deviation.
Measured measured(double value, double sigma, Dimension dimension);
// "± 3.4 mrad"; two significant digits.
std::string sigma_text(double sigma, Dimension dimension);
// "0.10 m", "12 mm": `digits` significant ones.
std::string quantity(double value, Dimension dimension, int digits = 3);

std::string fixed(double value, int decimals);  // "−0.52"
std::string significant(double value, int digits);
std::string count(std::size_t number);         // "307,200"
std::string short_count(std::size_t number);   // "307k"
std::string duration(double seconds);          // "0.9 ms", "12 s"
std::string size_words(std::uintmax_t bytes);  // "12 kB", "1.5 GB"
std::string p_value_text(double p);            // "p 0.41", "p < 0.001"

}  // namespace patchlab::viewer
