/// One axis of a plot: values to places, and which values get a tick.
///
/// Threads  pure; any.
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace frustumscreen {

class Axis {
public:
    explicit Axis(bool logarithmic) : logarithmic_(logarithmic) {}

    /// Finite, and positive on a logarithmic axis.
    [[nodiscard]] bool shows(double value) const;
    void include(double value);
    /// Values below `least` lie at the axis's lower end, `least` itself. Before `settle`.
    void begin_at(double least);
    /// After the last `include`: some room at the ends that are not fixed.
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
    bool fixed_low_ = false;
    double low_ = std::numeric_limits<double>::infinity();
    double high_ = -std::numeric_limits<double>::infinity();
};

} // namespace frustumscreen
