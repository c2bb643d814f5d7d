#include "tests/bench/fit/arithmetic.h"

namespace patchlab::bench {

double arithmetic(std::size_t flops) {
  using Lanes = double __attribute__((vector_size(32)));
  const Lanes factor = {0.999, 0.998, 0.997, 0.996}, term = {0.001, 0.002, 0.003, 0.004};
  Lanes a = term, b = a + a, c = b + a, d = c + a, e = d + a, f = e + a, g = f + a, h = g + a, i = h + a,
        j = i + a;
  for (std::size_t done = 0; done < flops; done += 80) {
    a = a * factor + term;
    b = b * factor + term;
    c = c * factor + term;
    d = d * factor + term;
    e = e * factor + term;
    f = f * factor + term;
    g = g * factor + term;
    h = h * factor + term;
    i = i * factor + term;
    j = j * factor + term;
  }
  const Lanes sum = a + b + c + d + e + f + g + h + i + j;
  return sum[0] + sum[1] + sum[2] + sum[3];
}

}  // namespace patchlab::bench
