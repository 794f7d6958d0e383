#include "app/bench/plot_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace frustumscreen {

bool Axis::shows(double value) const {
    return std::isfinite(value) && (!logarithmic_ || value > 0.0 || fixed_low_);
}

double Axis::scaled(double value) const {
    if (!logarithmic_) {
        return value;
    }
    return value > 0.0 ? std::log10(value) : low_;
}

void Axis::include(double value) {
    if (shows(value)) {
        low_ = fixed_low_ ? low_ : std::min(low_, scaled(value));
        high_ = std::max(high_, scaled(value));
    }
}

void Axis::begin_at(double least) {
    low_ = scaled(least);
    high_ = low_;
    fixed_low_ = true;
}

void Axis::settle() {
    if (!(low_ <= high_)) {
        low_ = 0.0;
        high_ = 1.0;
    }
    if (!logarithmic_ && !fixed_low_) {
        low_ = std::min(low_, 0.0);
    }
    const double room = std::max(0.06 * (high_ - low_), high_ == low_ ? 0.3 : 0.0);
    low_ -= !fixed_low_ && (logarithmic_ || low_ < 0.0) ? room : 0.0;
    high_ += room;
}

double Axis::place(double value) const {
    const double at = (scaled(value) - low_) / (high_ - low_);
    return fixed_low_ ? std::fmax(at, 0.0) : at;
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
        const double at = (scaled(value) - low_) / (high_ - low_);
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
    const bool least = fixed_low_ && place(value) < 1e-9;
    return fmt::format("{}{:g}", least ? "≤ " : "", !logarithmic_ && size < 1e-12 ? 0.0 : value);
}

} // namespace frustumscreen
