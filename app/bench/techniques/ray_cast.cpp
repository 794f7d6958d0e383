#include "app/bench/techniques/ray_cast.h"

#include "app/bench/techniques/memory_picture.h"
#include "app/bench/truth/truth.h"
#include "app/geometry/face_rays.h"
#include "firmware_host/base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace frustumscreen {

namespace {

constexpr int lanes = 8;

/// Linear light to sRGB codes by a table; off by no more than one code where it is steepest.
class CodeTable {
public:
    CodeTable() {
        for (std::size_t k = 0; k < codes_.size(); ++k) {
            codes_[k] =
                srgb8_from_linear((static_cast<double>(k) + 0.5) / static_cast<double>(codes_.size()));
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

/// Some pixels of one row on one face.
struct Span {
    std::size_t face = 0;
    int y = 0;
    int begin = 0, end = 0;
};

struct PixelRect {
    int left = 0, top = 0, right = 0, bottom = 0; ///< right and bottom are one past the end
};

/// A face as the projector's pixels see it.
struct CastFace {
    FaceRays rays;
    PixelRect pixels; ///< that may show the artifact
};

/// The pixels that the box may light through this face; all if a part of it is behind the eye.
PixelRect pixels_of(const Box& box, const std::optional<glm::dmat4>& clip, int width, int height) {
    const PixelRect all{0, 0, width, height};
    if (!clip) {
        return {};
    }
    glm::dvec2 low(std::numeric_limits<double>::infinity());
    glm::dvec2 high(-std::numeric_limits<double>::infinity());
    for (unsigned k = 0; k < 8; ++k) {
        const glm::dvec4 at =
            *clip * glm::dvec4((k & 1U) != 0 ? box.high.x : box.low.x, (k & 2U) != 0 ? box.high.y : box.low.y,
                               (k & 4U) != 0 ? box.high.z : box.low.z, 1.0);
        if (!(at.w > 0.0)) {
            return all;
        }
        const glm::dvec2 pixel = (0.5 * glm::dvec2(at) / at.w + 0.5) * glm::dvec2(width, height);
        low = glm::min(low, pixel);
        high = glm::max(high, pixel);
    }
    const auto clamped = [](double value, int size) {
        return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(size)));
    };
    return {clamped(std::floor(low.x) - 1.0, width), clamped(std::floor(low.y) - 1.0, height),
            clamped(std::ceil(high.x) + 1.0, width), clamped(std::ceil(high.y) + 1.0, height)};
}

/// The part of row `y` whose pixels' centres lie in the face.
Span span_of(const CastFace& cast, std::size_t face, int y) {
    double begin = cast.pixels.left;
    double end = cast.pixels.right;
    for (const glm::dvec3& edge : cast.rays.edges) {
        const double rest = edge.y * (y + 0.5) + edge.z; // edge.x u + rest <= 0
        if (edge.x > 0.0) {
            end = std::fmin(end, std::floor(-rest / edge.x - 0.5) + 1.0);
        } else if (edge.x < 0.0) {
            begin = std::fmax(begin, std::ceil(-rest / edge.x - 0.5));
        } else if (rest > 0.0) {
            end = begin;
        }
    }
    begin = std::fmin(begin, cast.pixels.right); // an edge along the row may be met anywhere
    return {face, y, static_cast<int>(begin), static_cast<int>(std::fmax(begin, end))};
}

class RayCast final : public Technique {
public:
    RayCast(const Stage& stage, std::shared_ptr<const TracedMesh> mesh, MemoryPicture picture)
        : stage_(stage), mesh_(std::move(mesh)), picture_(std::move(picture)) {}

    [[nodiscard]] std::string name() const override { return "ray cast"; }
    void draw(const BenchPose& pose) override {
        set_up(pose);
        cast([this](int x, int y, const glm::dvec3&, const RTCRayHit8& hits, int lane) {
            picture_.codes.at(x, y) = codes_.of(surface_colour(mesh_->mesh(), hits.hit.primID[lane],
                                                               static_cast<double>(hits.hit.u[lane]),
                                                               static_cast<double>(hits.hit.v[lane]))
                                                    .linear);
        });
        picture_.show(stage_, lit_);
    }
    [[nodiscard]] Result<ImageFloat> hit_points(const BenchPose& pose) override {
        set_up(pose);
        ImageFloat points(stage_.width(), stage_.height(),
                          glm::vec3(std::numeric_limits<float>::quiet_NaN()));
        cast([&](int x, int y, const glm::dvec3& direction, const RTCRayHit8& hits, int lane) {
            points.at(x, y) = glm::vec3(view_.eye_m + static_cast<double>(hits.ray.tfar[lane]) * direction);
        });
        return points;
    }

private:
    void set_up(const BenchPose& pose) {
        view_ = view_of(stage_.settings, pose);
        const PeerView faces = peer_view(stage_, pose);
        faces_.clear();
        spans_.clear();
        lit_ = {};
        for (const PropFace* face : faces.faces) {
            const CastFace cast{
                face_rays(*face, view_.projector, view_.prop_from_projector, view_.eye_m),
                pixels_of(mesh_->box(),
                          collineation(face->plane, view_.eye_m, faces.clip_from_prop, mesh_->box()),
                          stage_.width(), stage_.height())};
            for (int y = cast.pixels.top; y < cast.pixels.bottom; ++y) {
                const Span span = span_of(cast, faces_.size(), y);
                if (span.begin < span.end) {
                    spans_.push_back(span);
                    lit_ = united(lit_, {span.begin, y, span.end - span.begin, 1});
                }
            }
            faces_.push_back(cast);
        }
    }

    /// Calls found(x, y, direction, hits, lane) for each pixel that shows the artifact, on every core.
    template <typename Found> void cast(const Found& found) const {
        parallel_for(spans_.size(), 8, [&](std::size_t begin, std::size_t end) {
            for (std::size_t k = begin; k < end; ++k) {
                for (int x = spans_[k].begin; x < spans_[k].end; x += lanes) {
                    cast_packet(spans_[k], x, found);
                }
            }
        });
    }

    template <typename Found> void cast_packet(const Span& span, int left, const Found& found) const {
        alignas(32) std::array<int, lanes> valid{};
        alignas(32) RTCRayHit8 packet; // NOLINT(cppcoreguidelines-pro-type-member-init): lanes below
        std::array<glm::dvec3, lanes> directions;
        const glm::dmat3& direction = faces_[span.face].rays.direction;
        for (int lane = 0; lane < lanes; ++lane) {
            const auto k = static_cast<std::size_t>(lane);
            valid[k] = left + lane < span.end ? -1 : 0;
            directions[k] = direction * glm::dvec3(left + lane + 0.5, span.y + 0.5, 1.0);
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
                found(left + lane, span.y, directions[static_cast<std::size_t>(lane)], packet, lane);
            }
        }
    }

    const Stage& stage_;
    std::shared_ptr<const TracedMesh> mesh_;
    MemoryPicture picture_;
    CodeTable codes_;
    TruthView view_;
    std::vector<CastFace> faces_;
    std::vector<Span> spans_;
    PixelRectangle lit_;
};

} // namespace

Result<std::unique_ptr<Technique>> make_ray_cast(const Stage& stage, std::shared_ptr<const TracedMesh> mesh) {
    Result<MemoryPicture> picture = MemoryPicture::create(stage);
    if (!picture) {
        return tl::unexpected<Error>(picture.error());
    }
    return std::make_unique<RayCast>(stage, std::move(mesh), std::move(*picture));
}

} // namespace frustumscreen
