/// How the pictures of the preview's page are taken: the usual table, projector and prop, and the visitor before it.
///
/// A frustum stands at the centre of the usual table under the usual projector. A standing cube's sides get no light from
/// straight above, so for a cube the projector hangs above the visitor's head.
///
/// Frames   table T, metres.
/// Threads  pure; any. A view uses all cores.
#pragma once

#include "app/geometry/transform.h"
#include "app/image/image.h"
#include "app/pack/pack.h"
#include "app/show/offline_scene.h"
#include "app/simulation/visitor_view.h"

#include <glm/glm.hpp>

#include <vector>

namespace frustumscreen::programs {

/// table_from_prop of a whole turn, counter-clockwise seen from above, in equal steps from the front.
[[nodiscard]] std::vector<geometry::RigidTransform> turned_props(int count);

/// At the finest level. `projected_width`: of the projector's picture; 0: the projector's own.
[[nodiscard]] Result<show::OfflineSetup> preview_setup(const pack::PackDescription& pack,
                                                       int projected_width);

/// The prop is at the table's centre.
[[nodiscard]] simulation::VisitorScene preview_visitor(const settings::Settings& settings,
                                                       const geometry::Pinhole& projector);

/// One camera for all pictures; the prop's outline is as large as it fits.
[[nodiscard]] simulation::VisitorCamera preview_camera(const simulation::VisitorScene& scene,
                                                       const std::vector<geometry::RigidTransform>& props,
                                                       const glm::ivec2& size);

[[nodiscard]] image::Image8 preview_picture(const simulation::VisitorScene& visitor,
                                            const image::Image8& projected,
                                            const simulation::VisitorCamera& camera);

/// Copies a picture to its place in a sheet of pictures of one size.
void put_in_sheet(const image::Image8& picture, int column, int row, image::Image8& sheet);

} // namespace frustumscreen::programs
