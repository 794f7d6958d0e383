/// Finds the flat surface under an object that its scan has taken along: a table, a floor, a turntable.
///
/// Method   RANSAC (Fischler and Bolles 1981) over triangles that are spread evenly over the area: the plane that holds most area,
///          fitted once more. It is a table if nearly all else lies on one side of it and it reaches beyond that on all sides.
///          The bottom of a plinth, a book or a plate reaches no farther than what stands on it.
///          Triangles lower than 0.4 % of the scan's size above the plane count as table, a foot's lowest ones too.
/// Frame    the file's; no axis need be up.
/// Threads  pure; any.
#pragma once

#include "assets_baked/bake/last_look.h"

namespace frustumscreen::bake {

/// The table's triangles, and what lies below them; `ignored` are left out of account. Nothing is found in a mesh of less than
/// 100 triangles.
[[nodiscard]] Scraps find_table(const SourceMesh& mesh, const Scraps& ignored);

} // namespace frustumscreen::bake
