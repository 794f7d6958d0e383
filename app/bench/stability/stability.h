/// Numerical stability on stiff and extreme cases, as a table: what was measured, against which bound, and
/// whether it held. docs/stability.md says why each bound holds.
///
/// Each case is a pure function, but for those that ask a driver. It compares the program's 64-bit (or, where the GPU takes over, 32-bit)
/// numbers with long double arithmetic of its own: rays, planes and pinholes the ordinary way, exponentials
/// from the library's long double.
///
/// Errors   none: what a case cannot find (recordings, a driver) it leaves out, with a sentence.
/// Threads  one caller: floating-point exceptions are flags of the thread.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen {

struct StabilityRow {
    std::string quantity; ///< with its unit
    double bound = 0.0;
    double observed = 0.0;
    [[nodiscard]] bool held() const { return observed <= bound; } ///< false for NaN
};

struct StabilityResult {
    std::vector<StabilityRow> rows;
    std::string left_out{}; ///< why something was not measured; empty = all was
};

struct StabilityOptions {
    std::filesystem::path recordings; ///< of trackers; none or missing: left out
    int triangles = 200'000;          ///< of the largest artifact
};

/// Whether floating-point exceptions count depends on the inputs: a NaN raises them in any comparison.
enum class FloatingPoint {
    Strict, ///< no invalid operation, division by zero or overflow anywhere
    Free,   ///< NaN and infinity go in, or foreign libraries work with them
};

struct StabilityCase {
    std::string theme;
    std::string name;
    FloatingPoint arithmetic = FloatingPoint::Strict;
    std::function<StabilityResult(const StabilityOptions&)> measure;
};

/// Every case, theme by theme.
[[nodiscard]] std::vector<StabilityCase> stability_cases();

/// Measures a case. A strict case's last row counts the kinds of floating-point exceptions that were raised.
[[nodiscard]] StabilityResult measure(const StabilityCase& which, const StabilityOptions& options);

/// How far a solution computed in steps is from the exact one.
struct StepError {
    std::string what;  ///< with the error's unit
    double step = 0.0; ///< of smoothers: / time constant; else seconds
    double error = 0.0;
};
/// The step response of a first-order smoother over one time constant (one step, if that is longer), as the
/// program computes it and by other methods of the textbooks.
[[nodiscard]] std::vector<StepError> smoother_step_errors();
/// The program's own dynamics at their own time constants.
[[nodiscard]] std::vector<StepError> program_step_errors();

} // namespace frustumscreen
