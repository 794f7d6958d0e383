/// A small world in memory: a body, a hinge without geometry on it, a lid on the hinge; three behaviours.
#pragma once

#include "app/pack/pack_world.h"
#include "tests/pack/samples.h"

#include <glm/gtc/quaternion.hpp>

#include <string>
#include <vector>

namespace frustumscreen::samples {

/// A cell's own pack: levels of both kinds and a relief, no texts. `seed` tells them apart.
inline pack::Pack cell_pack(unsigned seed) {
    pack::Pack pack = pack_with_reliefs();
    pack.title = "cell " + std::to_string(seed);
    pack.languages.clear();
    pack.captions.clear();
    pack.textures[0] = texture(9, 5, seed, true);
    return pack;
}
/// As above, with one mesh alone: few bytes.
inline pack::Pack small_cell_pack() {
    pack::Pack pack = samples::pack();
    pack.captions.clear();
    pack.levels.pop_back();
    pack.textures.pop_back();
    pack.relief = {};
    pack.default_level = 0;
    return pack;
}

/// One for each cell of `world()`.
inline std::vector<pack::Pack> cell_packs() {
    return {cell_pack(11), pack::Pack(), cell_pack(12)};
}

inline glm::dmat4 lid_from_geometry() {
    return glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, -0.05, 1.0 / 30.0)) *
           glm::scale(glm::dmat4(1.0), glm::dvec3(0.25));
}

inline std::vector<pack::PackCell> cells() {
    pack::PackCell body;
    body.cell.name = "body";
    body.cell.cell_from_geometry = glm::scale(glm::dmat4(1.0), glm::dvec3(0.5));
    body.cell.has_geometry = true;
    body.part = "cells/0.fspack";
    body.triangles = 123456;
    body.low = {-0.25, -0.125, 0.0};
    body.high = {0.25, 0.125, 0.4};
    pack::PackCell hinge;
    hinge.cell.name = "hinge \xC3\xA0 gauche";
    hinge.cell.parent = 0;
    hinge.cell.parent_from_base = glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.05, 0.4));
    hinge.cell.rest.rotation = glm::angleAxis(0.5, glm::dvec3(1.0, 0.0, 0.0));
    pack::PackCell lid;
    lid.cell.name = "lid";
    lid.cell.parent = 1;
    lid.cell.rest = {{0.01, 0.02, -0.03}, glm::angleAxis(-0.5, glm::dvec3(1.0, 0.0, 0.0)), {0.8, 0.9, 1.1}};
    lid.cell.cell_from_geometry = lid_from_geometry();
    lid.cell.has_geometry = true;
    lid.part = "cells/2.fspack";
    lid.triangles = 78;
    lid.low = {-0.09, -0.01, 0.43};
    lid.high = {0.1, 0.09, 0.6};
    return {body, hinge, lid};
}

/// Every interpolation and every path; a spring and a pendulum; every trigger with a number of its own.
inline std::vector<pack::PackBehaviour> behaviours() {
    using world::Interpolation;
    pack::PackBehaviour open;
    open.behaviour.name = "open";
    open.behaviour.trigger = world::Trigger::Hotspot;
    open.behaviour.hotspot = 1;
    open.behaviour.seconds = 2.0;
    open.behaviour.stays = true;
    open.behaviour.channels = {
        {2,
         world::Path::Rotation,
         {Interpolation::Linear, {0.0F, 2.0F}, {{0, 0, 0, 1}, {1, 0, 0, 0.000001F}}}},
        {2, world::Path::Translation, {Interpolation::Step, {0.25F}, {{0.1F, 1.0F / 3.0F, -2, 0}}}},
        {2,
         world::Path::Scale,
         {Interpolation::CubicSpline,
          {0.5F, 1.5F},
          {{0, 0, 0, 0}, {1, 1, 1, 0}, {-3, 0, 1, 0}, {0, 2, 0, 0}, {1, 2, 1, 0}, {0, 0, 0, 0}}}},
        {0, world::Path::Light, {Interpolation::Linear, {0.0F, 1.0F}, {{1, 1, 1, 0}, {0, 0.5F, 2, 0}}}}};
    open.titles = {{"en", "Turn the lid"}, {"pt-BR", "Vire a tampa"}};
    pack::PackBehaviour wobble;
    wobble.behaviour.name = "wobble";
    wobble.behaviour.seconds = 1.0 / 3.0;
    wobble.behaviour.repeats = true;
    wobble.behaviour.springs = {{2, true, {0.0, 0.6, 0.8}, -0.5, 1e9, 0.0}};
    wobble.behaviour.pendulums = {{1, {1.0, 0.0, 0.0}, 0.1, 0.3, 0.25}};
    pack::PackBehaviour told;
    told.behaviour.name = "told";
    told.behaviour.trigger = world::Trigger::Narration;
    told.behaviour.narration_s = 12.5;
    told.behaviour.pendulums = {{0, {0.0, 0.0, 1.0}, -3.0, 0.001, 1e6}};
    return {open, wobble, told};
}

inline pack::PackWorld world() {
    return {cells(), behaviours()};
}

/// A world made from full_pack(), which has two hotspots and sections of its own.
inline pack::Pack pack_with_world() {
    pack::Pack pack = full_pack();
    const Result<void> put = pack::put_world(pack, samples::world(), cell_packs());
    EXPECT_TRUE(put) << (put ? "" : put.error().message);
    return pack;
}

} // namespace frustumscreen::samples
