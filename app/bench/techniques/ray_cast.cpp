#include "app/bench/techniques/ray_cast.h"

#include "app/bench/techniques/memory_picture.h"
#include "app/bench/truth/truth.h"
#include "app/geometry/face_rays.h"
#include "app/render/sample_grid.h"
#include "app/scene/pixel_density.h"
#include "firmware_host/base/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace frustumscreen::bench {

namespace {

constexpr int lanes = 8;

/// Converts linear light to sRGB codes with a table; at most one code off where the curve is steepest.
class CodeTable {
public:
    CodeTable() {
        for (std::size_t k = 0; k < codes_.size(); ++k) {
            codes_[k] =
                image::srgb8_from_linear((static_cast<double>(k) + 0.5) / static_cast<double>(codes_.size()));
        }
    }
    [[nodiscard]] glm::u8vec4 of(const glm::vec3& linear) const {
        return {of(linear.r), of(linear.g), of(linear.b), 255};
    }

private:
    [[nodiscard]] std::uint8_t of(float linear) const {
        const float place = std::clamp(linear, 0.0F, 1.0F) * static_cast<float>(codes_.size());
        return codes_[std::min(static_cast<std::size_t>(place), codes_.size() - 1)];
    }
    std::array<std::uint8_t, 16384> codes_{};
};

/// A range of pixels of one row on one face.
struct Span {
    std::size_t face = 0;
    int y = 0;
    int begin = 0, end = 0;
};

/// The part of row `y` of the bounds whose pixel centres lie in the face.
Span span_of(const geometry::FaceRays& rays, const PixelRectangle& bounds, std::size_t face, int y) {
    double begin = bounds.x;
    double end = bounds.x + bounds.width;
    for (const glm::dvec3& edge : rays.edges) {
        const double rest = edge.y * (y + 0.5) + edge.z; // condition: edge.x u + rest <= 0
        if (edge.x > 0.0) {
            end = std::fmin(end, std::floor(-rest / edge.x - 0.5) + 1.0);
        } else if (edge.x < 0.0) {
            begin = std::fmax(begin, std::ceil(-rest / edge.x - 0.5));
        } else if (rest > 0.0) {
            end = begin;
        }
    }
    begin = std::fmin(begin, bounds.x + bounds.width); // an edge along the row may intersect it anywhere
    return {.face = face,
            .y = y,
            .begin = static_cast<int>(begin),
            .end = static_cast<int>(std::fmax(begin, end))};
}

class RayCast final : public Technique {
public:
    RayCast(const Kiosk& kiosk, std::shared_ptr<const TracedMesh> mesh, int samples, MemoryPicture picture)
        : kiosk_(kiosk), mesh_(std::move(mesh)), samples_(samples), picture_(std::move(picture)) {}

    [[nodiscard]] std::string name() const override {
        return samples_ > 1 ? fmt::format("ray cast ({} samples)", samples_) : "ray cast";
    }
    void draw(const BenchPose& pose) override {
        set_up(pose);
        parallel_for(spans_.size(), 8, [&](std::size_t begin, std::size_t end) {
            std::vector<glm::vec3> light;
            for (std::size_t k = begin; k < end; ++k) {
                light.assign(static_cast<std::size_t>(spans_[k].end - spans_[k].begin), glm::vec3(0.0F));
                add_light(spans_[k], light);
                write_codes(spans_[k], light);
            }
        });
        picture_.show(kiosk_, lit_);
    }
    [[nodiscard]] Result<image::ImageFloat> hit_points(const BenchPose& pose) override {
        set_up(pose);
        image::ImageFloat points(kiosk_.width(), kiosk_.height(),
                                 glm::vec3(std::numeric_limits<float>::quiet_NaN()));
        parallel_for(spans_.size(), 8, [&](std::size_t begin, std::size_t end) {
            for (std::size_t k = begin; k < end; ++k) {
                cast(spans_[k], glm::dvec2(0.5),
                     [&](int x, const glm::dvec3& direction, const RTCRayHit8& hits, int lane) {
                         points.at(x, spans_[k].y) =
                             glm::vec3(view_.eye_m + static_cast<double>(hits.ray.tfar[lane]) * direction);
                     });
            }
        });
        return points;
    }

private:
    void set_up(const BenchPose& pose) {
        view_ = view_of(kiosk_.settings, pose);
        const PeerView view = peer_view(kiosk_, pose);
        rays_.clear();
        spans_.clear();
        lit_ = {};
        const std::vector<PeerFace> faces = faces_before(mesh_->box(), view);
        grid_ = render::SampleGrid::of(
            samples_ > 1 ? scene::samples_at(pixel_density(faces, mesh_->box(), view), samples_) : 1);
        for (const PeerFace& face : faces) {
            const geometry::FaceRays rays =
                geometry::face_rays(*face.face, view_.projector, view_.prop_from_projector, view_.eye_m);
            for (int y = face.bounds.y; y < face.bounds.y + face.bounds.height; ++y) {
                const Span span = span_of(rays, face.bounds, rays_.size(), y);
                if (span.begin < span.end) {
                    spans_.push_back(span);
                    lit_ =
                        united(lit_, {.x = span.begin, .y = y, .width = span.end - span.begin, .height = 1});
                }
            }
            rays_.push_back(rays);
        }
    }

    /// Adds the linear light of every sample of the span's pixels; a miss adds nothing.
    void add_light(const Span& span, std::vector<glm::vec3>& light) const {
        for (int sample = 0; sample < grid_.x * grid_.y; ++sample) {
            const glm::dvec2 at = (glm::dvec2(sample % grid_.x, sample / grid_.x) + 0.5) / glm::dvec2(grid_);
            cast(span, at, [&](int x, const glm::dvec3&, const RTCRayHit8& hits, int lane) {
                light[static_cast<std::size_t>(x - span.begin)] +=
                    surface_colour(mesh_->mesh(), hits.hit.primID[lane],
                                   static_cast<double>(hits.hit.u[lane]),
                                   static_cast<double>(hits.hit.v[lane]))
                        .linear;
            });
        }
    }

    void write_codes(const Span& span, const std::vector<glm::vec3>& light) {
        const float share = 1.0F / static_cast<float>(grid_.x * grid_.y);
        for (int x = span.begin; x < span.end; ++x) {
            picture_.codes.at(x, span.y) = codes_.of(share * light[static_cast<std::size_t>(x - span.begin)]);
        }
    }

    /// Calls found(x, direction, hits, lane) for each pixel of the span whose ray, at this position in the
    /// pixel, meets the artifact.
    template <typename Found> void cast(const Span& span, const glm::dvec2& at, const Found& found) const {
        for (int x = span.begin; x < span.end; x += lanes) {
            cast_packet(span, x, at, found);
        }
    }

    template <typename Found>
    void cast_packet(const Span& span, int left, const glm::dvec2& at, const Found& found) const {
        alignas(32) std::array<int, lanes> valid{};
        alignas(32) RTCRayHit8 packet; // NOLINT(cppcoreguidelines-pro-type-member-init): lanes below
        std::array<glm::dvec3, lanes> directions;
        const glm::dmat3& direction = rays_[span.face].direction;
        for (int lane = 0; lane < lanes; ++lane) {
            const auto k = static_cast<std::size_t>(lane);
            valid[k] = left + lane < span.end ? -1 : 0;
            directions[k] = direction * glm::dvec3(left + lane + at.x, span.y + at.y, 1.0);
            packet.ray.org_x[lane] = static_cast<float>(view_.eye_m.x);
            packet.ray.org_y[lane] = static_cast<float>(view_.eye_m.y);
            packet.ray.org_z[lane] = static_cast<float>(view_.eye_m.z);
            packet.ray.dir_x[lane] = static_cast<float>(directions[k].x);
            packet.ray.dir_y[lane] = static_cast<float>(directions[k].y);
            packet.ray.dir_z[lane] = static_cast<float>(directions[k].z);
            packet.ray.tnear[lane] = 0.0F;
            packet.ray.tfar[lane] = std::numeric_limits<float>::infinity();
            packet.ray.time[lane] = 0.0F;
            packet.ray.mask[lane] = 0xFFFFFFFFU;
            packet.ray.flags[lane] = 0;
            packet.ray.id[lane] = 0;
            packet.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
            packet.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
        }
        RTCIntersectContext context{};
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        rtcIntersect8(valid.data(), mesh_->scene(), &context, &packet);
        for (int lane = 0; lane < lanes && left + lane < span.end; ++lane) {
            if (packet.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID) {
                found(left + lane, directions[static_cast<std::size_t>(lane)], packet, lane);
            }
        }
    }

    const Kiosk& kiosk_;
    std::shared_ptr<const TracedMesh> mesh_;
    int samples_;
    glm::ivec2 grid_{1, 1}; ///< samples along the sides of this picture's pixels
    MemoryPicture picture_;
    CodeTable codes_;
    TruthView view_;
    std::vector<geometry::FaceRays> rays_; ///< faces that show anything
    std::vector<Span> spans_;
    PixelRectangle lit_;
};

} // namespace

Result<std::unique_ptr<Technique>> make_ray_cast(const Kiosk& kiosk, std::shared_ptr<const TracedMesh> mesh,
                                                 int samples) {
    TRY(MemoryPicture picture, MemoryPicture::create(kiosk));
    return std::make_unique<RayCast>(kiosk, std::move(mesh), samples, std::move(picture));
}

} // namespace frustumscreen::bench
