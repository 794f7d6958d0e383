/// One axis of a plot: values to places, and which values get a tick.
///
/// Threads  pure; any.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace frustumscreen {

class Axis {
public:
    explicit Axis(bool logarithmic) : logarithmic_(logarithmic) {}

    /// Finite, and positive on a logarithmic axis.
    [[nodiscard]] bool shows(double value) const;
    void include(double value);
    /// The axis goes no lower than `least` (positive on a logarithmic one): what lies below is shown there.
    /// Before the first `include`.
    void no_lower_than(double least) { least_ = scaled(least); }
    /// After the last `include`: some room at the ends.
    void settle();
    /// 0..1.
    [[nodiscard]] double place(double value) const;
    [[nodiscard]] std::vector<double> ticks() const;
    /// As it is written beside a tick: next to 0 counts as 0 where steps are added up, not where they are
    /// multiplied.
    [[nodiscard]] std::string number(double value) const;

private:
    [[nodiscard]] double scaled(double value) const;

    bool logarithmic_;
    std::optional<double> least_; ///< scaled
    double low_ = std::numeric_limits<double>::infinity();
    double high_ = -std::numeric_limits<double>::infinity();
};

} // namespace frustumscreen
