#include "app/programs/sheet/sheet_animation.h"

#include "app/simulation/visitor_view.h"

#include <webp/encode.h>
#include <webp/mux.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace frustumscreen::programs {

namespace {

constexpr double used_share = 0.90; ///< limit of the prop's extent in the picture
/// On scales to 100 and 6. Maximum effort takes ten times as long and saves almost nothing.
constexpr float lossless_effort = 30.0F;
constexpr int lossless_method = 3;
constexpr int min_frame_ms = 20; ///< browsers slow down shorter frames
constexpr int longest_frame_ms = 500;

/// One camera for each frame: at its eye; all look at one place with one focal length.
std::vector<simulation::VisitorCamera> cameras_for(const settings::Settings& settings,
                                                   const std::vector<SheetFrame>& frames,
                                                   const AnimationOptions& options) {
    const geometry::PropShape prop = settings::make_prop(settings.prop);
    geometry::RigidTransform middle;
    for (const SheetFrame& frame : frames) {
        middle.translation +=
            frame.tracked_state.table_from_prop.translation / static_cast<double>(frames.size());
    }
    std::vector<simulation::VisitorCamera> cameras;
    double reach = 0.0; // distance of the farthest corner from the centre, in half pictures
    double focal_px = 1e30;
    for (const SheetFrame& frame : frames) {
        cameras.push_back(simulation::visitor_camera(prop, middle, frame.tracked_state.eye_m, options.width,
                                                     options.height));
        focal_px = std::min(focal_px, cameras.back().pinhole.fx);
    }
    for (std::size_t k = 0; k < frames.size(); ++k) {
        geometry::Pinhole& pinhole = cameras[k].pinhole;
        pinhole.fx = pinhole.fy = focal_px;
        const geometry::RigidTransform camera_from_prop =
            cameras[k].table_from_camera.inverse() * frames[k].tracked_state.table_from_prop;
        for (const geometry::PropFace& face : prop.faces) {
            for (const glm::dvec3& corner : face.corners) {
                if (const auto pixel = pinhole.pixel(camera_from_prop.point(corner))) {
                    reach = std::max({reach, std::abs(pixel->x - pinhole.cx) / pinhole.cx,
                                      std::abs(pixel->y - pinhole.cy) / pinhole.cy});
                }
            }
        }
    }
    for (simulation::VisitorCamera& camera : cameras) {
        camera.pinhole.fx = camera.pinhole.fy = reach > 0.0 ? focal_px * used_share / reach : focal_px;
    }
    return cameras;
}

struct DeleteEncoder {
    void operator()(WebPAnimEncoder* encoder) const { WebPAnimEncoderDelete(encoder); }
};

/// A WebP picture that frees its pixels.
class Picture {
public:
    Picture() { valid_ = WebPPictureInit(&picture_) != 0; }
    ~Picture() { WebPPictureFree(&picture_); }
    Picture(const Picture&) = delete;
    Picture& operator=(const Picture&) = delete;
    [[nodiscard]] bool import(const image::Image8& image) {
        picture_.use_argb = 1;
        picture_.width = image.width;
        picture_.height = image.height;
        return valid_ &&
               WebPPictureImportRGBX(&picture_, reinterpret_cast<const std::uint8_t*>(image.texels.data()),
                                     image.width * 4) != 0;
    }
    [[nodiscard]] WebPPicture* get() { return &picture_; }

private:
    WebPPicture picture_{};
    bool valid_ = false;
};

class Encoder {
public:
    explicit Encoder(const AnimationOptions& options) {
        WebPAnimEncoderOptions encoder_options;
        valid_ = WebPAnimEncoderOptionsInit(&encoder_options) != 0 && WebPConfigInit(&config_) != 0;
        encoder_options.anim_params.loop_count = 0; // endless
        encoder_options.kmax = 30;
        config_.lossless = options.lossless ? 1 : 0;
        config_.quality = options.lossless ? lossless_effort : options.quality;
        config_.method = options.lossless ? lossless_method : 4;
        encoder_.reset(valid_ ? WebPAnimEncoderNew(options.width, options.height, &encoder_options)
                              : nullptr);
    }
    [[nodiscard]] bool add(const image::Image8& image, int at_ms) {
        Picture picture;
        return encoder_ && picture.import(image) &&
               WebPAnimEncoderAdd(encoder_.get(), picture.get(), at_ms, &config_) != 0;
    }
    [[nodiscard]] Result<Bytes> finish(int end_ms) {
        WebPData data;
        WebPDataInit(&data);
        if (!encoder_ || WebPAnimEncoderAdd(encoder_.get(), nullptr, end_ms, nullptr) == 0 ||
            WebPAnimEncoderAssemble(encoder_.get(), &data) == 0) {
            WebPDataClear(&data);
            return fail(ErrorKind::Internal, "sheet.encoder", "animation: the WebP encoder failed");
        }
        const auto* const begin = reinterpret_cast<const std::byte*>(data.bytes);
        Bytes bytes(begin, begin + data.size);
        WebPDataClear(&data);
        return bytes;
    }

private:
    bool valid_ = false;
    WebPConfig config_{};
    std::unique_ptr<WebPAnimEncoder, DeleteEncoder> encoder_;
};

int duration_ms(const std::vector<SheetFrame>& frames, std::size_t from, std::size_t to) {
    const Nanoseconds apart =
        frames[std::max(from, to)].tracked_state.time - frames[std::min(from, to)].tracked_state.time;
    return std::clamp(static_cast<int>(std::lround(std::min(1e3 * to_seconds(apart), 1e6))), min_frame_ms,
                      longest_frame_ms);
}

} // namespace

Result<Bytes> visitor_animation(const settings::Settings& settings, const std::vector<SheetFrame>& frames,
                                const AnimationOptions& options,
                                const std::function<void(std::size_t, std::size_t)>& progress) {
    const std::vector<simulation::VisitorCamera> cameras = cameras_for(settings, frames, options);
    std::vector<image::Image8> views;
    for (std::size_t k = 0; k < frames.size(); ++k) {
        TRY(const image::Image8 picture, read_picture(frames[k], settings.projector.pinhole));
        const simulation::VisitorScene scene =
            visitor_scene(settings, frames[k].tracked_state, picture.width, picture.height);
        views.push_back(simulation::visitor_view(scene, picture, cameras[k], {true, 2, false}));
        progress(k + 1, frames.size());
    }
    Encoder encoder(options);
    int at_ms = 0;
    bool sound = true;
    for (std::size_t k = 0; k < views.size(); ++k) { // forwards
        sound = sound && encoder.add(views[k], at_ms);
        const bool last = k + 1 == views.size();
        at_ms += options.closed && last && k > 0 ? duration_ms(frames, k - 1, k)
                                                 : duration_ms(frames, k, last ? k : k + 1);
    }
    for (std::size_t k = options.closed ? 1 : views.size() - 1; k-- > 1;) { // backwards
        sound = sound && encoder.add(views[k], at_ms);
        at_ms += duration_ms(frames, k, k - 1);
    }
    if (!sound) {
        return fail(ErrorKind::Internal, "sheet.encoder_end", "animation: the WebP encoder failed");
    }
    return encoder.finish(at_ms);
}

} // namespace frustumscreen::programs
