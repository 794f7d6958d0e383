// Torches' contents, held against rays and the content's own definition (torch_thrown_world.h).

#include "tests/render/torch_thrown_world.h"

#include <string>

namespace frustumscreen::synthetic {
namespace {

/// On the frustum, and on a cube in the hand.
void check_on_both(Throw thrown, int poses = 3) {
    ThrownWorld(thrown).check(poses);
    thrown.name += ", cube";
    thrown.prop = geometry::make_cube(0.16);
    ThrownWorld(thrown).check(poses);
}

TEST(TorchContent, PicturesAndFilmsFollowTheTorchPose) {
    check_on_both({.name = "picture", .stage = {.source = torch::Source::Picture}});
    check_on_both({.name = "film",
                   .stage = {.source = torch::Source::Film, .opacity = 0.7},
                   .blend = torch::Blend::Light,
                   .height_per_width = 0.75});
    check_on_both({.name = "picture that scrolls",
                   .stage = {.source = torch::Source::Picture, .scroll_per_s = {0.1, 0.03}},
                   .seconds = 2.0,
                   .height_per_width = 0.75});
    check_on_both({.name = "picture that turns",
                   .stage = {.source = torch::Source::Picture, .turn_rad_per_s = 0.2},
                   .seconds = 3.0,
                   .height_per_width = 0.75});
    ThrownWorld({.name = "picture on a relief",
                 .stage = {.source = torch::Source::Picture},
                 .way = Way::RasterizedRelief})
        .check(3);
}

TEST(TorchContent, RingsAndGridsMatchTheirDefinition) {
    check_on_both({.name = "ring",
                   .stage = {.source = torch::Source::Ring, .size = 0.5, .width = 0.06},
                   .max_off = 0.05});
    check_on_both({.name = "ring that pulses",
                   .stage = {.source = torch::Source::Ring,
                             .size = 0.4,
                             .width = 0.08,
                             .scroll_per_s = {0.05, -0.1},
                             .pulse_hz = 0.4,
                             .pulse_depth = 0.5},
                   .seconds = 1.0,
                   .height_per_width = 0.75,
                   .max_off = 0.05});
    check_on_both({.name = "grid",
                   .stage = {.source = torch::Source::Grid, .size = 0.2, .width = 0.06},
                   .max_off = 0.05});
    check_on_both(
        {.name = "grid that turns",
         .stage = {.source = torch::Source::Grid, .size = 0.2, .width = 0.06, .turn_rad_per_s = 0.3},
         .blend = torch::Blend::Light,
         .seconds = 2.0,
         .height_per_width = 0.75});
}

TEST(TorchContent, ARulerHasItsMarksAtMillimetres) {
    check_on_both({.name = "ruler", .stage = {.source = torch::Source::Ruler}, .max_off = 0.2}, 6);
    check_on_both({.name = "ruler that turns",
                   .stage = {.source = torch::Source::Ruler, .turn_rad_per_s = 0.3},
                   .seconds = 2.0,
                   .max_off = 0.2},
                  6);
}

TEST(TorchContent, ALensMagnifiesWhatTheTorchSees) {
    check_on_both({.name = "lens",
                   .stage = {.source = torch::Source::Lens, .size = 0.7, .magnification = 2.0},
                   .blend = torch::Blend::Light,
                   .max_off = 0.05});
    check_on_both({.name = "lens that scrolls",
                   .stage = {.source = torch::Source::Lens,
                             .size = 0.5,
                             .magnification = 1.5,
                             .scroll_per_s = {0.1, -0.05}},
                   .blend = torch::Blend::Light,
                   .seconds = 1.0,
                   .max_off = 0.05});
}

TEST(TorchContent, ALayerCoversTheSurfaceInTheBeam) {
    check_on_both({.name = "layer", .stage = {.source = torch::Source::Layer, .colour = {0.2F, 0.7F, 0.9F}}});
    Throw many{.name = "layer of many colours",
               .stage = {.source = torch::Source::Layer, .opacity = 0.8},
               .layer_is_painted = true};
    check_on_both(many);
    many.name = "layer of many colours on a relief";
    many.way = Way::RasterizedRelief;
    ThrownWorld(many).check(3);
    many.name = "layer of many colours on a relief of the GPU";
    many.way = Way::DrawnRelief;
    ThrownWorld(many).check(3);
}

TEST(TorchContent, StagesAreLaidOverEachOther) {
    check_on_both({.name = "grid over a picture",
                   .stage = {.source = torch::Source::Picture, .opacity = 0.7},
                   .more = {{.source = torch::Source::Grid,
                             .colour = {0.9F, 0.2F, 0.1F},
                             .opacity = 0.8,
                             .size = 0.2,
                             .width = 0.06}},
                   .max_off = 0.05});
    check_on_both({.name = "ring over a layer",
                   .stage = {.source = torch::Source::Layer, .opacity = 0.6},
                   .more = {{.source = torch::Source::Ring, .colour = {0.1F, 0.8F, 0.9F}, .width = 0.08}},
                   .height_per_width = 0.75,
                   .max_off = 0.05,
                   .layer_is_painted = true});
    check_on_both({.name = "filter and ring on a film",
                   .stage = {.source = torch::Source::Film, .opacity = 0.6},
                   .more = {{.source = torch::Source::Grid,
                             .mix = torch::Mix::Multiply,
                             .colour = {0.3F, 0.8F, 0.5F},
                             .opacity = 0.9,
                             .size = 0.25,
                             .width = 0.1},
                            {.source = torch::Source::Ring,
                             .mix = torch::Mix::Add,
                             .colour = {0.2F, 0.1F, 0.3F},
                             .size = 0.6,
                             .width = 0.1}},
                   .blend = torch::Blend::Light,
                   .max_off = 0.05});
    check_on_both(
        {.name = "lens and plain light on a layer",
         .stage = {.source = torch::Source::Layer, .opacity = 0.5},
         .more = {{.source = torch::Source::Lens, .opacity = 0.7, .size = 0.6, .magnification = 2.0},
                  {.source = torch::Source::Plain,
                   .mix = torch::Mix::Add,
                   .colour = {0.1F, 0.2F, 0.1F},
                   .opacity = 0.4}},
         .max_off = 0.05,
         .layer_is_painted = true});
    ThrownWorld({.name = "grid over a layer, on a relief",
                 .stage = {.source = torch::Source::Layer, .opacity = 0.6},
                 .more = {{.source = torch::Source::Grid,
                           .colour = {0.9F, 0.2F, 0.1F},
                           .opacity = 0.8,
                           .size = 0.2,
                           .width = 0.06}},
                 .way = Way::RasterizedRelief,
                 .max_off = 0.05,
                 .layer_is_painted = true})
        .check(3);
}

/// Each stage in its own way.
TEST(TorchContent, StagesScrollTurnAndPulseAtOnce) {
    const auto moving = [](torch::Stage stage) {
        stage.scroll_per_s = {0.06, -0.04};
        stage.turn_rad_per_s = 0.25;
        stage.pulse_hz = 0.3;
        stage.pulse_depth = 0.6;
        return stage;
    };
    const torch::Stage grid =
        moving({.source = torch::Source::Grid, .colour = {0.9F, 0.2F, 0.1F}, .size = 0.2, .width = 0.06});
    check_on_both({.name = "a moving picture under a moving grid",
                   .stage = {.source = torch::Source::Picture,
                             .scroll_per_s = {-0.05, 0.02},
                             .turn_rad_per_s = -0.15,
                             .pulse_hz = 0.7,
                             .pulse_depth = 0.4},
                   .more = {grid},
                   .seconds = 1.7,
                   .height_per_width = 0.75,
                   .max_off = 0.05});
    for (const torch::Source source : {torch::Source::Ring, torch::Source::Ruler, torch::Source::Lens}) {
        const bool is_ruler = source == torch::Source::Ruler;
        check_on_both({.name = std::string("moving ") +
                               std::string(torch::source_names.at(static_cast<std::size_t>(source))),
                       .stage = moving({.source = source, .size = 0.5, .width = 0.08}),
                       .blend = source == torch::Source::Lens ? torch::Blend::Light : torch::Blend::Over,
                       .seconds = 1.3,
                       .height_per_width = 0.75,
                       .max_off = is_ruler ? 0.2 : 0.05},
                      is_ruler ? 7 : 3);
    }
}

} // namespace
} // namespace frustumscreen::synthetic
