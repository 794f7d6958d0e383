/// Numerical stability in stiff and extreme cases, as a table: the measured value, its bound, and whether the
/// bound held. docs/stability.md justifies each bound.
///
/// Each case is a pure function, except those that query a driver. It compares the program's 64-bit (or, from
/// the GPU on, 32-bit) numbers with independent long double arithmetic: rays, planes and pinholes in the
/// ordinary way, exponentials from the library's long double.
///
/// Errors   none: a case that lacks its input (recordings, a driver) is skipped, with a sentence.
/// Threads  one caller: floating-point exceptions are flags of the thread.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen::bench {

struct StabilityRow {
    std::string quantity; ///< includes its unit
    double bound = 0.0;
    double observed = 0.0;
    [[nodiscard]] bool held() const { return observed <= bound; } ///< false for NaN
};

struct StabilityResult {
    std::vector<StabilityRow> rows;
    std::string left_out{}; ///< why something was not measured; empty if everything was
};

struct StabilityOptions {
    std::filesystem::path recordings; ///< of trackers; empty or missing: skipped
    int triangles = 200'000;          ///< of the largest artifact
};

/// Whether floating-point exceptions count depends on the inputs: a NaN raises them in any comparison.
enum class FloatingPoint {
    Strict, ///< no invalid operation, division by zero or overflow anywhere
    Free,   ///< inputs contain NaN and infinity, or foreign libraries compute
};

struct StabilityCase {
    std::string theme;
    std::string name;
    FloatingPoint arithmetic = FloatingPoint::Strict;
    std::function<StabilityResult(const StabilityOptions&)> measure;
};

/// Every case, theme by theme.
[[nodiscard]] std::vector<StabilityCase> stability_cases();

/// Measures a case. The last row of a strict case counts the kinds of floating-point exceptions raised.
[[nodiscard]] StabilityResult measure(const StabilityCase& which, const StabilityOptions& options);

/// The distance of a stepwise solution from the exact one.
struct StepError {
    std::string what;  ///< includes the error's unit
    double step = 0.0; ///< smoothers: step / time constant; else seconds
    double error = 0.0;
};
/// The step response of a first-order smoother over one time constant (one step, if that is longer), as
/// computed by the program and by other textbook methods.
[[nodiscard]] std::vector<StepError> smoother_step_errors();
/// The program's own dynamics at their own time constants.
[[nodiscard]] std::vector<StepError> program_step_errors();

} // namespace frustumscreen::bench
