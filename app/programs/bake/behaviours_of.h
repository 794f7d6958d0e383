/// The behaviours of an artifact: those of the folder's file, and the model's animations that it does not name, each
/// started by a button.
///
/// Errors   one line that begins with the behaviour's place: an animation or a part that the model does not have.
/// Threads  pure; any.
#pragma once

#include "app/pack/pack_world.h"
#include "app/programs/bake/bake_request.h"
#include "app/programs/bake/cells_choice.h"
#include "assets_baked/bake/source_mesh.h"
#include "assets_baked/folder/artifact_behaviours.h"
#include "firmware_host/base/result.h"

#include <span>
#include <string>
#include <vector>

namespace frustumscreen::programs {

/// `cell` of channels, springs and pendulums is the index of a node of the mesh. `lost`: a sentence for each animation
/// beyond the number that a world may have.
[[nodiscard]] Result<std::vector<pack::PackBehaviour>>
behaviours_of(std::span<const folder::ArtifactBehaviour> written, const bake::SourceMesh& mesh,
              std::vector<std::string>& lost);

/// The same for a request; none if the bake makes no cells. Notes what is lost.
[[nodiscard]] Result<std::vector<pack::PackBehaviour>> movements_of(const BakeRequest& request,
                                                                    const bake::SourceMesh& mesh,
                                                                    const CellsChoice& cells,
                                                                    std::vector<bake::SourceNote>& notes);

/// Time until a damped oscillator of mass 1 counts as still: a thousandth of its reach is left.
[[nodiscard]] double settling_s(double stiffness_per_s2, double damping_per_s);

} // namespace frustumscreen::programs
