// The physical reference: what this core can do with numbers that never leave its registers.
#pragma once

#include <cstddef>

namespace patchlab::bench {

// About `flops` additions and multiplications, fused and four at a time where the machine can. What they
// gave.
double arithmetic(std::size_t flops);

// Of one evaluation of eight parameters' normal equations, counted from the formulas: residual and row 113,
// sums of products 90.
inline constexpr double flops_per_point = 203.0;

}  // namespace patchlab::bench
