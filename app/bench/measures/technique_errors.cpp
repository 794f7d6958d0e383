#include "app/bench/measures/picture_shift.h"
#include "app/bench/measures/technique_set.h"
#include "app/bench/techniques/relief_surface.h"
#include "app/pack/pack_file.h"
#include "app/render/read_back.h"
#include "app/render/sample_grid.h"
#include "assets_baked/bake/level.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

namespace frustumscreen::bench {

Result<std::string> TechniqueSet::keep_drawn(const pack::Pack& pack, std::uint32_t level) {
    const pack::PackLevel& shown = pack.levels[level];
    return keep_surface(pack, bake::textured_source(shown, pack.textures[shown.texture], pack.box_size),
                        fmt::format("level {}", level));
}

Result<std::string> TechniqueSet::keep_drawn(const pack::Pack& pack, const relief::BlockRelief& relief,
                                             const std::string& name) {
    return keep_surface(pack, cut_surface_of(relief), name);
}

Result<std::string> TechniqueSet::keep_surface(const pack::Pack& pack, bake::SourceMesh surface,
                                               const std::string& name) {
    if (drawn_.contains(name)) {
        return name;
    }
    const double metres_per_box = pack::place(pack, kiosk_.prop).metres_per_box;
    TRY(Truth truth,
        Truth::build(std::make_shared<const bake::SourceMesh>(std::move(surface)),
                     glm::scale(glm::dmat4(1.0), glm::dvec3(metres_per_box)), bake::Sides::Front));
    drawn_.emplace(name, std::move(truth));
    return name;
}

std::optional<LightAim> TechniqueSet::shown_light(const BenchPose& pose) const {
    for (const std::unique_ptr<Technique>& technique : techniques_) {
        if (const ShownPicture* const shown = technique->as_shown()) {
            return shown->light(pose);
        }
    }
    return std::nullopt;
}

ShownImages TechniqueSet::shown_images(ShownPicture& shown, const BenchPose& pose) const {
    const auto read = [this] {
        return render::read_colour(kiosk_.framebuffer, kiosk_.width(), kiosk_.height());
    };
    shown.draw_shown(pose);
    image::Image8 colour = read();
    const int samples = shown.draw_white(pose);
    return {std::move(colour), read(), samples};
}

Result<void> TechniqueSet::measure_errors(const Truth& truth, const std::vector<BenchPose>& poses,
                                          std::size_t first, const Progress& progress) {
    for (std::size_t pose = 0; pose < poses.size(); ++pose) {
        const TruthView view = view_of(kiosk_.settings, poses[pose]);
        const std::optional<LightAim> light = shown_light(poses[pose]);
        const TruthPicture cast = truth.cast(kiosk_.prop, view, true, light ? &*light : nullptr);
        std::map<int, image::Image<float>> covers; // key: samples per pixel
        std::map<std::string, image::Image8> surfaces;
        for (const auto& [name, as_drawn] : drawn_) {
            surfaces[name] = as_drawn.cast(kiosk_.prop, view, true).colour16;
        }
        for (std::size_t k = first; k < techniques_.size(); ++k) {
            if (results_[k].kind == TechniqueKind::Floor) {
                continue;
            }
            TRY(const Drawn seen, drawn(k, poses[pose]));
            PictureError& error = results_[k].errors.emplace_back(measure(cast, seen));
            if (const auto own = surfaces.find(results_[k].drawn_as); own != surfaces.end()) {
                error.drawn_shift_px =
                    glm::length(picture_shift(own->second, seen.colour).value_or(glm::dvec2(0.0)));
            }
            if (ShownPicture* const shown = techniques_[k]->as_shown()) {
                const ShownImages images = shown_images(*shown, poses[pose]);
                const auto cover = covers.try_emplace(images.samples).first;
                if (cover->second.width == 0) {
                    cover->second =
                        truth.cover(kiosk_.prop, view, cast, render::SampleGrid::of(images.samples));
                }
                error.shown = measure_shown(cast, images, cover->second, seen.point_m);
            }
            results_[k].estimates.push_back(techniques_[k]->estimate(poses[pose]));
        }
        progress(static_cast<double>(pose + 1) / static_cast<double>(poses.size()));
    }
    for (std::size_t k = first; k < results_.size(); ++k) {
        results_[k].error = summarise(results_[k].errors);
    }
    return {};
}

Result<std::vector<PictureError>> TechniqueSet::shape_errors(const Truth& truth, const BenchPose& pose) {
    const TruthPicture cast = truth.cast(kiosk_.prop, view_of(kiosk_.settings, pose), false);
    std::vector<PictureError> errors(techniques_.size());
    for (std::size_t k = 0; k < techniques_.size(); ++k) {
        if (results_[k].kind != TechniqueKind::Floor) {
            TRY(const Drawn seen, places(k, pose));
            errors[k] = measure(cast, seen);
        }
    }
    return errors;
}

Result<void> TechniqueSet::measure_shape(const Truth& truth, const std::vector<BenchPose>& poses, int rays,
                                         const Progress& progress) {
    const glm::ivec2 grid = render::SampleGrid::of(rays);
    const geometry::Pinhole centres = kiosk_.settings.projector.pinhole;
    for (std::size_t pose = 0; pose < poses.size(); ++pose) {
        std::vector<std::vector<PictureError>> errors(techniques_.size());
        for (int ray = 0; ray < rays; ++ray) {
            // Move the principal point, to draw and cast at other places inside the pixels.
            geometry::Pinhole& pinhole = kiosk_.settings.projector.pinhole;
            const glm::ivec2 cell(ray % grid.x, ray / grid.x);
            pinhole.cx = centres.cx + 0.5 - (cell.x + 0.5) / grid.x;
            pinhole.cy = centres.cy + 0.5 - (cell.y + 0.5) / grid.y;
            const Result<std::vector<PictureError>> found = shape_errors(truth, poses[pose]);
            pinhole = centres;
            TRY_VOID(found);
            for (std::size_t k = 0; k < errors.size(); ++k) {
                errors[k].push_back((*found)[k]);
            }
        }
        for (std::size_t k = 0; k < errors.size(); ++k) {
            if (results_[k].kind != TechniqueKind::Floor) {
                results_[k].errors.push_back(summarise(errors[k]).mean);
                results_[k].estimates.push_back(techniques_[k]->estimate(poses[pose]));
            }
        }
        progress(static_cast<double>(pose + 1) / static_cast<double>(poses.size()));
    }
    for (TechniqueResult& result : results_) {
        result.error = summarise(result.errors);
    }
    return {};
}

} // namespace frustumscreen::bench
