#include "app/bench/room/room_techniques.h"

#include "app/show/room_show.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace frustumscreen::bench {

void find_seen(const RoomSet& set, const RoomFrame& frame, std::vector<SeenObject>& seen) {
    const geometry::PropFace& face = set.screen().surface.faces.front();
    std::array<geometry::Plane, 4> sides{}; // their normals look inward
    for (std::size_t k = 0; k < sides.size(); ++k) {
        const glm::dvec3& from = face.corners[k];
        const glm::dvec3& to = face.corners[(k + 1) % sides.size()];
        glm::dvec3 normal = glm::cross(from - frame.eye_m, to - frame.eye_m);
        normal /= glm::length(normal);
        const double inside = glm::dot(normal, set.screen().surface.middle - frame.eye_m);
        normal = inside < 0.0 ? -normal : normal;
        sides.at(k) = {normal, glm::dot(normal, frame.eye_m)};
    }
    seen.clear();
    for (std::size_t k = 0; k < set.room().objects.size(); ++k) {
        const room::Object& object = set.room().objects[k];
        const glm::dvec3 box_m = object.size_m * set.ways_of(object).box_size;
        SeenObject one{.object = k, .table_from_object = room::table_from_object(object, frame.seconds)};
        one.middle_m = one.table_from_object.point({0.0, 0.0, 0.5 * box_m.z});
        one.radius_m = 0.5 * glm::length(box_m);
        one.away_m = std::fmax(glm::distance(one.middle_m, frame.eye_m) - one.radius_m, 1e-3);
        const bool outside = std::any_of(sides.begin(), sides.end(), [&](const geometry::Plane& side) {
            return side.distance(one.middle_m) < -one.radius_m;
        });
        if (!outside) {
            seen.push_back(one);
        }
    }
}

double pixel_angle(const RoomSet& set, const glm::dvec3& eye_m) {
    const std::array<glm::dvec3, 4>& corners_m = set.settings().screen.corners_m;
    const double pixel_m = glm::distance(corners_m[0], corners_m[1]) / set.settings().screen.width;
    return pixel_m / std::fmax(set.screen().surface.faces.front().plane.distance(eye_m), pixel_m);
}

namespace {

class Ours final : public RoomTechnique {
public:
    explicit Ours(RoomSet& set, std::unique_ptr<show::RoomShow> show) : set_(set), show_(std::move(show)) {}
    [[nodiscard]] std::string name() const override { return "ours"; }
    void draw(const RoomFrame& frame) override {
        (void)show_->draw(frame.seconds, std::span(&frame.eye_m, 1), set_.target(),
                          render::Redraw::Everything);
    }
    [[nodiscard]] const scene::FramePlan& plan() const override { return show_->plans().front(); }
    [[nodiscard]] const render::Renderer& renderer() const override { return show_->renderer(); }

private:
    RoomSet& set_;
    std::unique_ptr<show::RoomShow> show_;
};

/// Draws each object that is seen in the way that `choose` gives it.
class Peer : public RoomTechnique {
public:
    explicit Peer(RoomSet& set) : set_(set) {
        constexpr std::size_t some_indices = 300'000; // it grows in the first pass
        plan_ = scene::make_plan(set.screen().surface, some_indices, set.room().objects.size());
        parts_.reserve(set.room().objects.size());
        ways_.reserve(set.room().objects.size());
    }
    void draw(const RoomFrame& frame) final {
        find_seen(set_, frame, seen_);
        ways_.clear();
        choose(frame, seen_, ways_);
        parts_.clear();
        for (std::size_t k = 0; k < seen_.size(); ++k) {
            scene::Part& part = parts_.emplace_back();
            part.level = ways_[k]->placed;
            part.level.metres_per_box = set_.room().objects[seen_[k].object].size_m;
            part.level.prop_from_placed = seen_[k].table_from_object.matrix();
        }
        const scene::FlatScreen& screen = set_.screen();
        scene::plan_frame(screen.surface, parts_,
                          {.projector = screen.pinhole,
                           .table_from_projector = screen.table_from_pinhole,
                           .table_from_prop = {},
                           .eyes_m = {&frame.eye_m, 1}},
                          plan_);
        set_.renderer().draw(plan_, set_.target(), render::Redraw::Everything);
    }
    [[nodiscard]] const scene::FramePlan& plan() const final { return plan_; }
    [[nodiscard]] const render::Renderer& renderer() const final { return set_.renderer(); }

protected:
    [[nodiscard]] const RoomSet& set() const { return set_; }
    [[nodiscard]] const room::Object& object(const SeenObject& seen) const {
        return set_.room().objects[seen.object];
    }
    /// Appends one way for each.
    virtual void choose(const RoomFrame& frame, std::span<const SeenObject> seen,
                        std::vector<const RoomWay*>& ways) = 0;

private:
    RoomSet& set_;
    scene::FramePlan plan_;
    std::vector<SeenObject> seen_;
    std::vector<const RoomWay*> ways_;
    std::vector<scene::Part> parts_;
};

/// The coarsest that errs by at most so much; otherwise the finest.
const RoomWay& coarsest_within(const std::vector<RoomWay>& ways, double error_box) {
    const auto found = std::find_if(ways.begin(), ways.end(),
                                    [error_box](const RoomWay& way) { return way.error_box <= error_box; });
    return found != ways.end() ? *found : ways.back();
}

class Polygons final : public Peer {
public:
    Polygons(RoomSet& set, double error_mm) : Peer(set), error_mm_(error_mm) {}
    [[nodiscard]] std::string name() const override { return "polygons"; }
    [[nodiscard]] std::string setting() const override { return fmt::format("{:.3g} mm", error_mm_); }

private:
    void choose(const RoomFrame&, std::span<const SeenObject> seen,
                std::vector<const RoomWay*>& ways) override {
        for (const SeenObject& each : seen) {
            ways.push_back(
                &coarsest_within(set().ways_of(object(each)).meshes, 1e-3 * error_mm_ / object(each).size_m));
        }
    }
    double error_mm_;
};

class Relief final : public Peer {
public:
    Relief(RoomSet& set, double error_mm, bool shell_as_polygons)
        : Peer(set), error_mm_(error_mm), shell_as_polygons_(shell_as_polygons) {}
    [[nodiscard]] std::string name() const override { return "relief"; }
    [[nodiscard]] std::string setting() const override {
        return fmt::format("{:.3g} mm{}", error_mm_, shell_as_polygons_ ? ", walls as polygons" : "");
    }

private:
    void choose(const RoomFrame&, std::span<const SeenObject> seen,
                std::vector<const RoomWay*>& ways) override {
        for (const SeenObject& each : seen) {
            const RoomWays& of = set().ways_of(object(each));
            const bool polygons = of.reliefs.empty() || (of.is_shell && shell_as_polygons_);
            ways.push_back(
                &coarsest_within(polygons ? of.meshes : of.reliefs, 1e-3 * error_mm_ / object(each).size_m));
        }
    }
    double error_mm_;
    bool shell_as_polygons_;
};

class Lod final : public Peer {
public:
    Lod(RoomSet& set, double error_px) : Peer(set), error_px_(error_px) {}
    [[nodiscard]] std::string name() const override { return "lod"; }
    [[nodiscard]] std::string setting() const override { return fmt::format("{:.3g} px", error_px_); }

private:
    void choose(const RoomFrame& frame, std::span<const SeenObject> seen,
                std::vector<const RoomWay*>& ways) override {
        const double tolerance = error_px_ * pixel_angle(set(), frame.eye_m);
        for (const SeenObject& each : seen) {
            ways.push_back(&coarsest_within(set().ways_of(object(each)).lods,
                                            tolerance * each.away_m / object(each).size_m));
        }
    }
    double error_px_;
};

} // namespace

Result<std::unique_ptr<RoomTechnique>> make_room_ours(RoomSet& set) {
    TRY(std::unique_ptr<show::RoomShow> show,
        show::RoomShow::create(set.settings(), {.samples = set.samples(), .both_eyes = false}));
    return std::make_unique<Ours>(set, std::move(show));
}

std::unique_ptr<RoomTechnique> make_room_polygons(RoomSet& set, double error_mm) {
    return std::make_unique<Polygons>(set, error_mm);
}

std::unique_ptr<RoomTechnique> make_room_relief(RoomSet& set, double error_mm, bool shell_as_polygons) {
    return std::make_unique<Relief>(set, error_mm, shell_as_polygons);
}

std::unique_ptr<RoomTechnique> make_room_lod(RoomSet& set, double error_px) {
    return std::make_unique<Lod>(set, error_px);
}

namespace {

/// The paper's two ways to draw an object.
const RoomWay& polygon_way(const RoomWays& of, double size_m, const PaperPolygons& polygons) {
    if (polygons.each == 0) {
        return coarsest_within(of.meshes, 1e-3 * polygons.error_mm / size_m);
    }
    const auto off = [&](const RoomWay& way) {
        return std::abs(std::log(static_cast<double>(way.polygons) / static_cast<double>(polygons.each)));
    };
    return *std::min_element(of.lods.begin(), of.lods.end(),
                             [&](const RoomWay& a, const RoomWay& b) { return off(a) < off(b); });
}

/// The coarsest one whose texel is not clearly larger than a pixel from here; otherwise the finest.
const RoomWay& relief_way(const RoomWays& of, double size_m, double away_m, double pixel_rad) {
    constexpr double not_clearly = 1.25; // as quality_level_of has it
    const auto fine = std::find_if(of.reliefs.begin(), of.reliefs.end(), [&](const RoomWay& way) {
        return way.texel_box * size_m <= not_clearly * pixel_rad * away_m;
    });
    return fine != of.reliefs.end() ? *fine : of.reliefs.back();
}

PaperCell paper_cell(const RoomSet& set, const SeenObject& seen, const RoomFrame& frame, double pixel_rad,
                     const PaperPolygons& polygons) {
    const room::Object& object = set.room().objects[seen.object];
    const RoomWays& of = set.ways_of(object);
    const RoomWay& mesh = polygon_way(of, object.size_m, polygons);
    const RoomWay& relief = of.reliefs.empty() ? mesh : relief_way(of, object.size_m, seen.away_m, pixel_rad);
    const glm::dvec3 to_object = seen.middle_m - frame.eye_m;
    const glm::dvec3 gaze = set.screen().surface.middle - frame.eye_m; // at the screen's middle
    const double away_m = std::fmax(glm::length(to_object), 1e-3);
    const double pixels_across = 2.0 * seen.radius_m / (away_m * pixel_rad);
    const double pixels = 0.785 * pixels_across * pixels_across; // of its ball's disc
    const double all = static_cast<double>(set.settings().screen.width) * set.settings().screen.height;
    return {.texel_px = relief.texel_box * object.size_m / (away_m * pixel_rad),
            .away_m = away_m,
            .cosine = glm::dot(to_object, gaze) / (away_m * glm::length(gaze)),
            .area_share = std::fmin(pixels / all, 1.0),
            .polygons = mesh.polygons,
            .relief_error_mm = 1e3 * object.size_m * pixels * relief.error_box,
            .polygon_error_mm = 1e3 * object.size_m * pixels * mesh.error_box};
}

class Paper final : public Peer {
public:
    Paper(RoomSet& set, const PaperWeights& weights, const PaperPolygons& polygons, double polygons_a_frame)
        : Peer(set), polygons_(polygons), budget_(polygons_a_frame), choice_(weights, polygons_a_frame) {}
    [[nodiscard]] std::string name() const override { return "paper"; }
    [[nodiscard]] std::string setting() const override {
        return fmt::format("{:.0f} polygons a frame", budget_);
    }

private:
    void choose(const RoomFrame& frame, std::span<const SeenObject> seen,
                std::vector<const RoomWay*>& ways) override {
        const double pixel_rad = pixel_angle(set(), frame.eye_m);
        cells_.clear();
        for (const SeenObject& each : seen) {
            cells_.push_back(paper_cell(set(), each, frame, pixel_rad, polygons_));
        }
        const std::span<const std::uint8_t> chosen = choice_.choose(cells_);
        for (std::size_t k = 0; k < seen.size(); ++k) {
            const RoomWays& of = set().ways_of(object(seen[k]));
            const double size_m = object(seen[k]).size_m;
            ways.push_back(chosen[k] != 0 || of.reliefs.empty()
                               ? &polygon_way(of, size_m, polygons_)
                               : &relief_way(of, size_m, seen[k].away_m, pixel_rad));
        }
    }
    PaperPolygons polygons_;
    double budget_;
    PaperChoice choice_;
    std::vector<PaperCell> cells_;
};

} // namespace

std::unique_ptr<RoomTechnique> make_room_paper(RoomSet& set, const PaperWeights& weights,
                                               const PaperPolygons& polygons, double polygons_a_frame) {
    return std::make_unique<Paper>(set, weights, polygons, polygons_a_frame);
}

double all_room_polygons(const RoomSet& set, const PaperPolygons& polygons) {
    double sum = 0.0;
    for (const room::Object& object : set.room().objects) {
        sum += static_cast<double>(polygon_way(set.ways_of(object), object.size_m, polygons).polygons);
    }
    return sum;
}

PaperWeights room_weights(const RoomSet& set, const PaperPolygons& polygons,
                          std::span<const RoomFrame> frames) {
    std::vector<std::vector<PaperCell>> of_frames;
    std::vector<SeenObject> seen;
    for (const RoomFrame& frame : frames) {
        find_seen(set, frame, seen);
        std::vector<PaperCell>& cells = of_frames.emplace_back();
        for (const SeenObject& each : seen) {
            cells.push_back(paper_cell(set, each, frame, pixel_angle(set, frame.eye_m), polygons));
        }
    }
    const double all = all_room_polygons(set, polygons);
    const std::array budgets{0.1 * all, 0.3 * all, 0.6 * all};
    return find_weights(of_frames, budgets);
}

} // namespace frustumscreen::bench
