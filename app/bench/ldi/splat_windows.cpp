#include "app/bench/ldi/splat_windows.h"

#include "app/bench/ldi/gpu_windows.h"
#include "app/bench/measures/timing.h"
#include "app/ldi/patch_layers.h"
#include "app/ldi/peers.h"
#include "app/ldi/point_patch.h"
#include "app/ldi/seen_points.h"
#include "app/ldi/triangle_rasterizer.h"

#include <array>
#include <functional>
#include <limits>
#include <utility>

namespace frustumscreen::bench {

namespace {

constexpr glm::dvec2 half_extent_m(0.5 * window_side_m);

/// The size of the cameras' pictures for `ours`, in windows. With 1, an eye between two cameras finds holes deep behind the window.
constexpr double our_margin = 1.4;

ldi::CameraView view_of(const WindowSet& set, double margin = 1.0) {
    return {.half_extent_m = half_extent_m, .width = set.pixels(), .height = set.pixels(), .margin = margin};
}

/// The depth pictures of all cameras of the hemisphere.
std::vector<ldi::DepthPicture> camera_pictures(const WindowSet& set, const ldi::Hemisphere& hemisphere,
                                               double margin = 1.0) {
    ldi::TriangleRasterizer rasterizer;
    std::vector<ldi::DepthPicture> pictures(ldi::camera_count);
    for (std::size_t camera = 0; camera < pictures.size(); ++camera) {
        pictures[camera].begin(ldi::camera_at(view_of(set, margin), hemisphere.cameras().at(camera)));
        rasterizer.draw(*set.scene().world, pictures[camera]);
    }
    return pictures;
}
std::span<const ldi::DepthPicture, ldi::camera_count> all_of(const std::vector<ldi::DepthPicture>& pictures) {
    return std::span<const ldi::DepthPicture, ldi::camera_count>(pictures);
}
/// The layered depth images of all patches.
std::vector<ldi::LayeredDepth> all_patches(const WindowSet& set, const ldi::Hemisphere& hemisphere,
                                           double margin = 1.0) {
    const std::vector<ldi::DepthPicture> pictures = camera_pictures(set, hemisphere, margin);
    std::vector<ldi::LayeredDepth> patches;
    for (std::size_t patch = 0; patch < ldi::patch_count; ++patch) {
        patches.push_back(ldi::patch_layers(hemisphere, patch, all_of(pictures), view_of(set, margin)));
    }
    return patches;
}
/// The point that each pixel shows; NaN: none.
image::ImageFloat points_in(const ldi::DepthPicture& picture) {
    const ldi::PictureMap map(picture.camera);
    image::ImageFloat points(picture.camera.width, picture.camera.height,
                             glm::vec3(std::numeric_limits<float>::quiet_NaN()));
    for (int y = 0; y < points.height; ++y) {
        for (int x = 0; x < points.width; ++x) {
            const float nearness = picture.nearness[picture.at(x, y)];
            if (nearness > 0.0F) {
                points.at(x, y) = glm::vec3(map.point(x + 0.5, y + 0.5, static_cast<double>(nearness)));
            }
        }
    }
    return points;
}

class Splatted final : public WindowTechnique {
public:
    using Splat = std::function<void(const glm::dvec3& eye_m, ldi::DepthPicture& picture)>;
    Splatted(WindowSet& set, std::string name, Splat splat, std::uint64_t bytes, double make_ms)
        : set_(set), name_(std::move(name)), splat_(std::move(splat)), bytes_(bytes), make_ms_(make_ms) {}
    [[nodiscard]] std::string name() const override { return name_; }
    void draw(const glm::dvec3& eye_m) override {
        picture_.begin(ldi::camera_through_window(eye_m, half_extent_m, set_.pixels(), set_.pixels()));
        splat_(eye_m, picture_);
        set_.show(picture_.colours);
    }
    [[nodiscard]] image::ImageFloat hit_points(const glm::dvec3& eye_m) override {
        draw(eye_m);
        return points_in(picture_);
    }
    [[nodiscard]] std::uint64_t bytes() const override { return bytes_; }
    [[nodiscard]] double make_ms() const override { return make_ms_; }

private:
    WindowSet& set_;
    std::string name_;
    Splat splat_;
    std::uint64_t bytes_;
    double make_ms_;
    ldi::DepthPicture picture_;
};

template <typename Values> std::uint64_t sum_of_bytes(const Values& values) {
    std::uint64_t sum = 0;
    for (const auto& value : values) {
        sum += value.bytes();
    }
    return sum;
}

class Ours final : public WindowTechnique {
public:
    Ours(WindowSet& set, const ldi::Hemisphere& hemisphere, std::vector<ldi::PointPatch> patches,
         double make_ms)
        : set_(set), hemisphere_(hemisphere), patches_(std::move(patches)), make_ms_(make_ms) {}
    [[nodiscard]] std::string name() const override { return "ours"; }
    void draw(const glm::dvec3& eye_m) override {
        const std::span<const std::uint64_t> words = splatter_.draw(patch_of(eye_m), camera_at(eye_m));
        codes_.resize(words.size());
        ldi::colours_of(words, codes_);
        set_.show(codes_);
    }
    [[nodiscard]] image::ImageFloat hit_points(const glm::dvec3& eye_m) override {
        ldi::DepthPicture picture;
        picture.begin(camera_at(eye_m));
        splatter_.draw(patch_of(eye_m), picture);
        return points_in(picture);
    }
    [[nodiscard]] std::uint64_t bytes() const override { return sum_of_bytes(patches_); }
    [[nodiscard]] double make_ms() const override { return make_ms_; }

private:
    [[nodiscard]] const ldi::PointPatch& patch_of(const glm::dvec3& eye_m) const {
        return patches_[nearest_patch(hemisphere_, eye_m)];
    }
    [[nodiscard]] ldi::PictureCamera camera_at(const glm::dvec3& eye_m) const {
        return ldi::camera_through_window(eye_m, half_extent_m, set_.pixels(), set_.pixels());
    }

    WindowSet& set_;
    ldi::Hemisphere hemisphere_;
    std::vector<ldi::PointPatch> patches_;
    double make_ms_;
    ldi::PointSplatter splatter_;
    std::vector<glm::u8vec4> codes_;
};

/// A patch's depth pixels, each as a point as large as its part of the surface. The pixel's slope extends the point along the ray; a
/// point is at most four pixels wide.
std::vector<GpuWindow::Vertex> points_of(const ldi::LayeredDepth& layers) {
    constexpr double max_pixels = 4.0;
    const ldi::PictureMap map(layers.camera);
    const double pixel_m = 2.0 * glm::length(layers.camera.half_right) / std::max(layers.camera.width, 1);
    const double plane_m = glm::distance(layers.camera.eye, layers.camera.middle);
    std::vector<GpuWindow::Vertex> points;
    points.reserve(layers.pixels.size());
    for (int y = 0; y < layers.camera.height; ++y) {
        for (int x = 0; x < layers.camera.width; ++x) {
            for (const ldi::DepthPixel& pixel : layers.at(x, y)) {
                const auto nearness = static_cast<double>(pixel.nearness);
                const double across_m = pixel_m / nearness;
                const double along_m =
                    plane_m * static_cast<double>(glm::length(pixel.slope)) / (nearness * nearness);
                points.push_back({.at_m = glm::vec3(map.point(x + 0.5, y + 0.5, nearness)),
                                  .colour = pixel.colour,
                                  .size_m = static_cast<float>(
                                      std::min(std::hypot(across_m, along_m), max_pixels * across_m))});
            }
        }
    }
    return points;
}

class Points final : public WindowTechnique {
public:
    Points(ldi::Hemisphere hemisphere, std::vector<GpuWindow> patches, double make_ms)
        : hemisphere_(std::move(hemisphere)), patches_(std::move(patches)), make_ms_(make_ms) {}
    [[nodiscard]] std::string name() const override { return "points"; }
    void draw(const glm::dvec3& eye_m) override { patches_[nearest_patch(hemisphere_, eye_m)].draw(eye_m); }
    [[nodiscard]] image::ImageFloat hit_points(const glm::dvec3& eye_m) override {
        return patches_[nearest_patch(hemisphere_, eye_m)].hit_points(eye_m);
    }
    [[nodiscard]] std::uint64_t bytes() const override { return sum_of_bytes(patches_); }
    [[nodiscard]] double make_ms() const override { return make_ms_; }

private:
    ldi::Hemisphere hemisphere_;
    std::vector<GpuWindow> patches_;
    double make_ms_;
};

} // namespace

std::unique_ptr<WindowTechnique> make_multi_ldi(WindowSet& set) {
    const double begun_ms = cpu_now_ms();
    const ldi::Hemisphere hemisphere(frozen_from_m);
    auto patches = std::make_shared<const std::vector<ldi::LayeredDepth>>(all_patches(set, hemisphere));
    const double make_ms = cpu_now_ms() - begun_ms;
    return std::make_unique<Splatted>(
        set, "multi_ldi_paper",
        [hemisphere, patches](const glm::dvec3& eye_m, ldi::DepthPicture& picture) {
            ldi::splat((*patches)[nearest_patch(hemisphere, eye_m)], picture);
        },
        sum_of_bytes(*patches), make_ms);
}

std::unique_ptr<WindowTechnique> make_window_ours(WindowSet& set) {
    const double begun_ms = cpu_now_ms();
    const ldi::Hemisphere hemisphere(frozen_from_m);
    std::vector<ldi::PointPatch> patches;
    for (const ldi::LayeredDepth& layers : all_patches(set, hemisphere, our_margin)) {
        ldi::SeenPoints seen(ldi::point_patch(layers), hemisphere, patches.size(), view_of(set, our_margin));
        while (seen.step()) {
        }
        patches.push_back(seen.take());
    }
    return std::make_unique<Ours>(set, hemisphere, std::move(patches), cpu_now_ms() - begun_ms);
}

std::unique_ptr<WindowTechnique> make_single_ldi(WindowSet& set) {
    const double begun_ms = cpu_now_ms();
    const ldi::Hemisphere hemisphere(frozen_from_m);
    const std::vector<ldi::DepthPicture> pictures = camera_pictures(set, hemisphere);
    auto layers = std::make_shared<const ldi::LayeredDepth>(
        ldi::single_ldi(hemisphere, all_of(pictures), view_of(set)));
    const double make_ms = cpu_now_ms() - begun_ms;
    return std::make_unique<Splatted>(
        set, "single_ldi",
        [layers](const glm::dvec3&, ldi::DepthPicture& picture) { ldi::splat(*layers, picture); },
        layers->bytes(), make_ms);
}

std::unique_ptr<WindowTechnique> make_image_based_object(WindowSet& set) {
    const double begun_ms = cpu_now_ms();
    auto object = std::make_shared<const ldi::ImageBasedObject>(
        ldi::image_based_object(*set.scene().world, frozen_from_m, view_of(set)));
    const double make_ms = cpu_now_ms() - begun_ms;
    return std::make_unique<Splatted>(
        set, "ibo", [object](const glm::dvec3&, ldi::DepthPicture& picture) { ldi::splat(*object, picture); },
        object->bytes(), make_ms);
}

Result<std::unique_ptr<WindowTechnique>> make_window_points(WindowSet& set) {
    const double begun_ms = cpu_now_ms();
    const ldi::Hemisphere hemisphere(frozen_from_m);
    std::vector<GpuWindow> patches;
    for (const ldi::LayeredDepth& layers : all_patches(set, hemisphere)) {
        TRY(GpuWindow window, GpuWindow::create(set, points_of(layers), {}));
        patches.push_back(std::move(window));
    }
    return std::make_unique<Points>(hemisphere, std::move(patches), cpu_now_ms() - begun_ms);
}

} // namespace frustumscreen::bench
