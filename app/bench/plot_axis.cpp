#include "app/bench/plot_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace frustumscreen {

bool Axis::shows(double value) const {
    return std::isfinite(value) && (!logarithmic_ || value > 0.0 || least_);
}

double Axis::scaled(double value) const {
    constexpr double none = -std::numeric_limits<double>::infinity();
    const double own = !logarithmic_ ? value : value > 0.0 ? std::log10(value) : none;
    return std::fmax(own, least_.value_or(none));
}

void Axis::include(double value) {
    if (shows(value)) {
        low_ = std::min(low_, scaled(value));
        high_ = std::max(high_, scaled(value));
    }
}

void Axis::settle() {
    if (!(low_ <= high_)) {
        low_ = 0.0;
        high_ = 1.0;
    }
    if (!logarithmic_) {
        low_ = std::min(low_, 0.0);
    }
    const double room = std::max(0.06 * (high_ - low_), high_ == low_ ? 0.3 : 0.0);
    low_ -= logarithmic_ || low_ < 0.0 ? room : 0.0;
    low_ = std::fmax(low_, least_.value_or(low_));
    high_ += room;
}

double Axis::place(double value) const {
    return (scaled(value) - low_) / (high_ - low_);
}

std::vector<double> Axis::ticks() const {
    std::vector<double> values;
    const double span = high_ - low_;
    if (logarithmic_) {
        constexpr std::array digits = {1.0, 2.0, 5.0, 1.5, 3.0, 4.0, 6.0, 8.0};
        const std::size_t count = span < 0.9 ? digits.size() : span < 2.6 ? 3 : 1;
        for (int decade = static_cast<int>(std::floor(low_)); decade <= static_cast<int>(std::ceil(high_));
             ++decade) {
            for (const double digit : std::span(digits).first(count)) {
                values.push_back(digit * std::pow(10.0, decade));
            }
        }
    } else {
        const double rough = span / 5.0;
        const double decade = std::pow(10.0, std::floor(std::log10(rough)));
        const double step = decade * (rough / decade > 5.0 ? 10.0 : rough / decade > 2.0 ? 5.0 : 2.0);
        for (double k = std::ceil(low_ / step); k * step <= high_; k += 1.0) {
            values.push_back(k * step);
        }
    }
    std::erase_if(values, [this](double value) {
        const double own = logarithmic_ ? std::log10(value) : value;
        const double at = (own - low_) / (high_ - low_);
        return at < -1e-9 || at > 1.0 + 1e-9;
    });
    return values;
}

std::string Axis::number(double value) const {
    const double size = std::abs(value);
    if (size >= 1e6) {
        return fmt::format("{:g}M", value / 1e6);
    }
    if (size >= 1e4) {
        return fmt::format("{:g}k", value / 1e3);
    }
    const bool least = least_ && scaled(value) <= *least_ + 1e-9;
    return fmt::format("{}{:g}", least ? "≤ " : "", !logarithmic_ && size < 1e-12 ? 0.0 : value);
}

} // namespace frustumscreen
