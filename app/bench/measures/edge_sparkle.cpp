#include "app/bench/measures/edge_sparkle.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <optional>

namespace frustumscreen::bench {

namespace {

constexpr double beside_from_px = 2.0, beside_to_px = 5.0;

/// A shared edge in pixels of the picture.
struct Segment {
    glm::dvec2 from{0.0};
    glm::dvec2 to{0.0};

    [[nodiscard]] double distance(const glm::dvec2& point) const {
        const glm::dvec2 along = to - from;
        const double t = glm::dot(point - from, along) / glm::dot(along, along);
        return glm::distance(point, from + std::clamp(t, 0.0, 1.0) * along);
    }
    /// Whether the edge's line crosses the pixel's square between the edge's ends.
    [[nodiscard]] bool crosses(const glm::dvec2& pixel_middle) const {
        const glm::dvec2 along = glm::normalize(to - from);
        const double t = glm::dot(pixel_middle - from, along);
        const double off = along.x * (pixel_middle.y - from.y) - along.y * (pixel_middle.x - from.x);
        return t >= 0.0 && t <= glm::distance(from, to) &&
               std::abs(off) < 0.5 * (std::abs(along.x) + std::abs(along.y));
    }
};

/// The corners shared by two faces; exact comparison works because both were computed from the same numbers.
std::vector<glm::dvec3> common_corners(const geometry::PropFace& a, const geometry::PropFace& b) {
    std::vector<glm::dvec3> common;
    for (const glm::dvec3& corner : a.corners) {
        if (std::find(b.corners.begin(), b.corners.end(), corner) != b.corners.end()) {
            common.push_back(corner);
        }
    }
    return common;
}

std::vector<Segment> shared_edges(const settings::Settings& settings, const geometry::PropShape& prop,
                                  const BenchPose& pose) {
    const geometry::RigidTransform prop_from_table = pose.table_from_prop.inverse();
    const geometry::RigidTransform& table_from_projector = settings.projector.table_from_projector;
    const glm::dvec3 eye = prop_from_table.point(pose.eye_m);
    const glm::dvec3 lens = prop_from_table.point(table_from_projector.translation);
    const geometry::RigidTransform projector_from_prop =
        table_from_projector.inverse() * pose.table_from_prop;
    const auto shows = [&](const geometry::PropFace& face) {
        return face.plane.distance(eye) > 0.0 && face.plane.distance(lens) > 0.0;
    };
    std::vector<Segment> edges;
    for (std::size_t a = 0; a < prop.faces.size(); ++a) {
        for (std::size_t b = a + 1; b < prop.faces.size(); ++b) {
            const std::vector<glm::dvec3> ends = common_corners(prop.faces[a], prop.faces[b]);
            if (ends.size() != 2 || !shows(prop.faces[a]) || !shows(prop.faces[b])) {
                continue;
            }
            const auto from = settings.projector.pinhole.pixel(projector_from_prop.point(ends[0]));
            const auto to = settings.projector.pinhole.pixel(projector_from_prop.point(ends[1]));
            if (from && to) {
                edges.push_back({*from, *to});
            }
        }
    }
    return edges;
}

EdgeZone zone_of(const Segment& edge, const glm::dvec2& pixel_middle) {
    if (edge.crosses(pixel_middle)) {
        return EdgeZone::Shared;
    }
    const double distance = edge.distance(pixel_middle);
    return distance < beside_from_px ? EdgeZone::Near
           : distance < beside_to_px ? EdgeZone::Beside
                                     : EdgeZone::Away;
}

/// The zone of a pixel over a step; nullopt: not judged.
std::optional<EdgeZone> judged_as(EdgeZone before, EdgeZone after) {
    if (before == EdgeZone::Shared || after == EdgeZone::Shared) {
        return EdgeZone::Shared;
    }
    return before == EdgeZone::Beside && after == EdgeZone::Beside ? std::optional(EdgeZone::Beside)
                                                                   : std::nullopt;
}

bool shows_artifact(const image::Image8& picture, int x, int y) {
    for (int k = 0; k < 9; ++k) {
        const glm::u8vec4& code = picture.at(x + k % 3 - 1, y + k / 3 - 1);
        if (code.r == 0 && code.g == 0 && code.b == 0) {
            return false;
        }
    }
    return true;
}

int change_of(const std::array<image::Image8, 2>& pictures, int x, int y) {
    const glm::ivec3 change = glm::abs(glm::ivec3(pictures[1].at(x, y)) - glm::ivec3(pictures[0].at(x, y)));
    return std::max({change.r, change.g, change.b});
}

/// Sharp and feathered pictures and the zones, for successive poses.
class Sequence {
public:
    Sequence(TechniqueSet& set, std::size_t sharp, std::size_t feathered)
        : set_(set), sharp_technique_(sharp), feathered_technique_(feathered) {}

    void add(const BenchPose& pose) {
        advance(sharp_, set_.picture(sharp_technique_, pose));
        advance(feathered_, set_.picture(feathered_technique_, pose));
        advance(zones_, edge_zones(set_.kiosk().settings, set_.kiosk().prop, pose));
        if (++poses_ >= 2) {
            add_step(sharp_, feathered_, zones_, sparkle_);
        }
    }
    [[nodiscard]] const EdgeSparkle& sparkle() const { return sparkle_; }

private:
    template <typename Picture> static void advance(std::array<Picture, 2>& pictures, Picture next) {
        pictures[0] = std::move(pictures[1]);
        pictures[1] = std::move(next);
    }

    TechniqueSet& set_;
    std::size_t sharp_technique_, feathered_technique_;
    std::array<image::Image8, 2> sharp_, feathered_; ///< before and after the step
    std::array<image::Image<EdgeZone>, 2> zones_;
    EdgeSparkle sparkle_;
    int poses_ = 0;
};

} // namespace

void ChangeHistogram::add(const ChangeHistogram& other) {
    for (std::size_t codes = 0; codes < counts_.size(); ++codes) {
        counts_[codes] += other.counts_[codes];
    }
}

std::int64_t ChangeHistogram::changes() const {
    return std::accumulate(counts_.begin(), counts_.end(), std::int64_t{0});
}

double ChangeHistogram::rms() const {
    double squares = 0.0;
    for (std::size_t codes = 0; codes < counts_.size(); ++codes) {
        squares += static_cast<double>(codes * codes) * static_cast<double>(counts_[codes]);
    }
    return std::sqrt(squares / static_cast<double>(std::max<std::int64_t>(1, changes())));
}

int ChangeHistogram::q999() const {
    const double least = 0.999 * static_cast<double>(changes());
    std::int64_t below = 0;
    for (std::size_t codes = 0; codes < counts_.size(); ++codes) {
        below += counts_[codes];
        if (static_cast<double>(below) >= least) {
            return static_cast<int>(codes);
        }
    }
    return 0;
}

int ChangeHistogram::largest() const {
    const auto last =
        std::find_if(counts_.rbegin(), counts_.rend(), [](std::int64_t count) { return count > 0; });
    return last == counts_.rend() ? 0 : static_cast<int>(counts_.rend() - last) - 1;
}

double ChangeHistogram::percent_over(int codes) const {
    const std::int64_t over = std::accumulate(counts_.begin() + codes + 1, counts_.end(), std::int64_t{0});
    return 100.0 * static_cast<double>(over) / static_cast<double>(std::max<std::int64_t>(1, changes()));
}

void EdgeSparkle::add(const EdgeSparkle& other) {
    sharp.add(other.sharp);
    feathered.add(other.feathered);
    beside_sharp.add(other.beside_sharp);
    beside_feathered.add(other.beside_feathered);
}

image::Image<EdgeZone> edge_zones(const settings::Settings& settings, const geometry::PropShape& prop,
                                  const BenchPose& pose) {
    const geometry::Pinhole& pinhole = settings.projector.pinhole;
    image::Image<EdgeZone> zones(pinhole.width, pinhole.height, EdgeZone::Away);
    for (const Segment& edge : shared_edges(settings, prop, pose)) {
        const glm::ivec2 low(glm::floor(glm::min(edge.from, edge.to) - beside_to_px));
        const glm::ivec2 high(glm::ceil(glm::max(edge.from, edge.to) + beside_to_px));
        for (int y = std::max(low.y, 0); y < std::min(high.y, zones.height); ++y) {
            for (int x = std::max(low.x, 0); x < std::min(high.x, zones.width); ++x) {
                zones.at(x, y) = std::max(zones.at(x, y), zone_of(edge, {x + 0.5, y + 0.5}));
            }
        }
    }
    return zones;
}

void add_step(const std::array<image::Image8, 2>& sharp, const std::array<image::Image8, 2>& feathered,
              const std::array<image::Image<EdgeZone>, 2>& zones, EdgeSparkle& sparkle) {
    for (int y = 1; y + 1 < zones[0].height; ++y) {
        for (int x = 1; x + 1 < zones[0].width; ++x) {
            const std::optional<EdgeZone> zone = judged_as(zones[0].at(x, y), zones[1].at(x, y));
            if (!zone || !shows_artifact(sharp[0], x, y) || !shows_artifact(sharp[1], x, y)) {
                continue;
            }
            const bool shared = *zone == EdgeZone::Shared;
            (shared ? sparkle.sharp : sparkle.beside_sharp).add(change_of(sharp, x, y));
            (shared ? sparkle.feathered : sparkle.beside_feathered).add(change_of(feathered, x, y));
        }
    }
}

Result<std::vector<SparkleRow>> edge_sparkle(const SetUp& set_up, const pack::Pack& pack,
                                             const std::vector<BenchPose>& poses, int steps,
                                             const PictureOptions& picture, const Progress& progress) {
    TRY(std::unique_ptr<TechniqueSet> set, TechniqueSet::open(set_up));
    const std::size_t sharp = set->results().size();
    for (const bool feathered : {false, true}) {
        PictureOptions options = picture;
        options.lit = true;
        options.feathered = feathered;
        TRY_VOID(set->add_level(pack, pack.default_level, options));
    }
    std::vector<SparkleRow> rows;
    for (std::size_t k = 0; k < 2 * poses.size(); ++k) {
        const bool along_x = k % 2 == 0;
        Sequence sequence(*set, sharp, sharp + 1);
        BenchPose pose = poses[k / 2];
        for (int step = 0; step <= steps; ++step) {
            sequence.add(pose);
            pose.table_from_prop.translation +=
                along_x ? glm::dvec3(sparkle_step_m, 0.0, 0.0) : glm::dvec3(0.0, sparkle_step_m, 0.0);
        }
        rows.push_back({static_cast<int>(k / 2), along_x, sequence.sparkle()});
        progress(static_cast<double>(k + 1) / (2.0 * static_cast<double>(poses.size())));
    }
    return rows;
}

} // namespace frustumscreen::bench
