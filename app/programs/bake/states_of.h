/// The states of an artifact, as the folder's file names them: parts and behaviours by name.
///
/// Errors   one line that begins with the state's place: a part or a behaviour that the model does not have, a part that is no
///          cell of its own.
/// Threads  pure; any.
#pragma once

#include "app/pack/pack_states.h"
#include "app/pack/pack_world.h"
#include "app/programs/bake/bake_request.h"
#include "assets_baked/bake/source_mesh.h"
#include "firmware_host/base/result.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen::programs {

/// True if a state hides parts, which must then be cells.
[[nodiscard]] bool hides_parts(const BakeRequest& request);

/// Checks the names before the bake. `behaviours`: what moves. Returns what each state is, a line each.
[[nodiscard]] Result<std::vector<std::string>> check_states(const BakeRequest& request,
                                                            const bake::SourceMesh& mesh,
                                                            std::span<const pack::PackBehaviour> behaviours);
/// `world`: as the pack has it; `cell_of`: one for each node of the mesh, none: no cell; empty: the pack has no cells.
[[nodiscard]] Result<std::vector<pack::PackState>>
states_of(const BakeRequest& request, const bake::SourceMesh& mesh, const pack::PackWorld& world,
          std::span<const std::optional<std::size_t>> cell_of);

} // namespace frustumscreen::programs
