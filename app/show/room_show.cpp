#include "app/show/room_show.h"

#include "app/room/room_file.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace frustumscreen::show {

namespace {

scene::StereoLayout layout_of(const settings::Settings& settings, const scene::FlatScreen& screen,
                              bool both_eyes) {
    return scene::stereo_layout(screen.pinhole,
                                both_eyes ? settings::screen_stereo_of(settings) : settings::Stereo::Off);
}

scene::FlatScreen screen_of(const settings::ScreenSettings& screen) {
    return scene::flat_screen(screen.corners_m, screen.width, screen.height);
}

} // namespace

RoomShow::RoomShow(const settings::Settings& settings, const RoomShowOptions& options, room::Room room,
                   render::Renderer renderer)
    : options_(options), room_(std::move(room)), screen_(screen_of(settings.screen)),
      layout_(layout_of(settings, screen_, options.both_eyes)),
      tolerance_px_(settings.render.error_tolerance_px), renderer_(std::move(renderer)) {}

Result<std::unique_ptr<RoomShow>> RoomShow::create(const settings::Settings& settings,
                                                   const RoomShowOptions& options) {
    TRY(room::Room room, room::read_room(settings.screen.room));
    const PixelSize size = layout_of(settings, screen_of(settings.screen), options.both_eyes).display;
    TRY(render::Renderer renderer,
        render::Renderer::create(size.width, size.height, residency::needs_of_room(options.samples)));
    std::unique_ptr<RoomShow> show(new RoomShow(settings, options, std::move(room), std::move(renderer)));
    for (const std::filesystem::path& file : show->room_.packs) {
        TRY(const residency::ReadModel read, residency::read_model(file));
        TRY(residency::RoomModel model, residency::upload(read, show->renderer_.store()));
        show->models_.push_back(std::move(model));
    }
    std::size_t indices = 0;
    for (const room::Object& object : show->room_.objects) {
        indices += show->models_[object.pack].max_indices();
    }
    show->parts_.reserve(show->room_.objects.size());
    for (std::size_t eye = 0; eye < show->layout_.count; ++eye) {
        show->plans_.push_back(scene::make_plan(show->screen_.surface, indices, show->room_.objects.size()));
    }
    return show;
}

const residency::ModelWay& RoomShow::choose(const residency::RoomModel& model, double size_m, double away_m,
                                            double tolerance_rad) const {
    const residency::ModelWay* chosen = nullptr;
    for (const residency::ModelWay& way : model.ways) {
        if (way.placed.relief) {
            continue;
        }
        const bool enough = way.mean_box * size_m <= tolerance_rad * away_m;
        if (chosen == nullptr || way.mean_box < chosen->mean_box) {
            chosen = &way;
        }
        if (enough) {
            break; // the levels go from coarse to fine
        }
    }
    return *chosen;
}

void RoomShow::place_objects(double seconds, const glm::dvec3& eye_m) {
    const double before_m = screen_.surface.faces.front().plane.distance(eye_m);
    const double pixel_m = glm::distance(screen_.surface.corners[0], screen_.surface.corners[1]) /
                           static_cast<double>(screen_.pinhole.width);
    const double tolerance_rad = tolerance_px_ * pixel_m / std::fmax(before_m, pixel_m);
    parts_.clear();
    double sum = 0.0;
    double weights = 0.0;
    for (std::size_t k = 0; k < room_.objects.size(); ++k) {
        const room::Object& object = room_.objects[k];
        const room::TakenPose pose = room::pose_of(k, object, seconds, taken_);
        if (pose.opacity <= 0.0) {
            continue;
        }
        const residency::RoomModel& model = models_[object.pack];
        const glm::dvec3 middle =
            pose.table_from_object.point({0.0, 0.0, 0.5 * pose.size_m * model.box_size.z});
        const double radius_m = 0.5 * pose.size_m * glm::length(model.box_size);
        const double away_m = std::fmax(glm::distance(middle, eye_m) - radius_m, 1e-3);
        const residency::ModelWay& way = choose(model, pose.size_m, away_m, tolerance_rad);
        scene::PlacedLevel placed = way.placed;
        placed.metres_per_box = pose.size_m;
        placed.samples = options_.samples;
        placed.prop_from_placed = pose.table_from_object.matrix();
        parts_.push_back({std::move(placed),
                          pose.opacity < 1.0 ? std::optional(relief::Dither{static_cast<float>(pose.opacity)})
                                             : std::nullopt});
        const double weight = pose.size_m * pose.size_m / (away_m * away_m);
        sum += weight * 1e3 * way.mean_box * pose.size_m;
        weights += weight;
    }
    error_mm_ = weights > 0.0 ? sum / weights : 0.0;
}

render::DrawResult RoomShow::draw(double seconds, std::span<const glm::dvec3> eyes_m,
                                  const render::RenderTarget& target, render::Redraw redraw) {
    place_objects(seconds, eyes_m.front());
    const scene::PlanView view{.projector = screen_.pinhole,
                               .table_from_projector = screen_.table_from_pinhole,
                               .table_from_prop = {},
                               .eyes_m = {}};
    const std::array<scene::PlanView, 2> views = scene::views_of(layout_, view, eyes_m);
    for (std::size_t eye = 0; eye < plans_.size(); ++eye) {
        scene::plan_frame(screen_.surface, parts_, views[eye], plans_[eye]);
    }
    return renderer_.draw(plans_, target, redraw);
}

} // namespace frustumscreen::show
