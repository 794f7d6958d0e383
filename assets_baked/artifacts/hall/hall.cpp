#include "assets_baked/artifacts/hall/hall.h"

#include "assets_baked/artifacts/hall/building.h"
#include "assets_baked/artifacts/hall/sculptures.h"
#include "assets_baked/artifacts/hall/vessels.h"

#include <array>

namespace frustumscreen::artifacts {
namespace {

using enum HallKind;
using enum HallSurface;

constexpr std::array<HallObject, 15> objects{{
    {"krater", "red-figure bell krater", Artifact, Open, make_krater},
    {"celadon-vase", "plum vase with carved petals under a green glaze", Artifact, Closed, make_celadon_vase},
    {"bowl", "porcelain bowl, painted in cobalt", Artifact, Closed, make_bowl},
    {"lamp", "Roman oil lamp of clay", Artifact, Open, make_lamp},
    {"column-drum", "fluted drum of a marble column", Artifact, Closed, make_column_drum},
    {"step-pyramid", "model of a pyramid of nine steps", Artifact, Closed, make_step_pyramid},
    {"tablet", "clay tablet with wedge writing", Artifact, Closed, make_tablet},
    {"figurine", "standing marble figure with folded arms", Artifact, Closed, make_figurine},
    {"helmet", "bronze helmet with a crest of horsehair", Artifact, Closed, make_helmet},
    {"shell", "shell of a sea snail", Artifact, Closed, make_shell},
    {"hall-floor", "chequered marble floor", Building, Open, make_hall_floor},
    {"hall-wall", "wall with panels, base and cornice", Building, Open, make_hall_wall},
    {"hall-ceiling", "coffered ceiling with a skylight", Building, Open, make_hall_ceiling},
    {"hall-plinth", "square plinth", Building, Closed, make_hall_plinth},
    {"hall-pedestal", "round pedestal", Building, Closed, make_hall_pedestal},
}};

} // namespace

std::span<const HallObject> hall_objects() {
    return objects;
}

} // namespace frustumscreen::artifacts
