#include "app/scene/pixel_density.h"

#include <numbers>

namespace frustumscreen::scene {

void PixelDensity::add(const PixelRectangle& bounds, double pixels_per_m) {
    const double area = static_cast<double>(bounds.width) * bounds.height;
    pixels_ += area * pixels_per_m;
    area_ += area;
}

double PixelDensity::share(double distance_m, const geometry::Pinhole& projector) const {
    return area_ > 0.0 ? pixels_ / area_ * distance_m / projector.fx : 1.0;
}

int samples_at(double density, int samples) {
    constexpr double min_density = 0.5;
    constexpr int most = 16;
    while (samples > 0 && samples < most && density > 0.0 && density < min_density) {
        samples *= 2;
        density *= std::numbers::sqrt2;
    }
    return samples;
}

} // namespace frustumscreen::scene
