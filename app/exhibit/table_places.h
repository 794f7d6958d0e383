/// Places for pictures of one size on the reader's table, arranged in rows and columns.
///
/// A lattice of rows and columns is symmetric about the line from the reader to the prop: a place is used only
/// together with its mirror image. If the number is odd, one place is left empty: the last in reading order.
///
/// Method   for each size from the largest down, lattices are tried: spread evenly or packed against both edges,
///          between the table's edges or beside the caption. Rows at even distances with the same columns outweigh a
///          small difference of picture size; among equal lattices the one nearest to the reader is taken.
/// Frames   the reader's (readers_table.h), metres.
/// Threads  pure; any. Allocates.
#pragma once

#include "app/exhibit/readers_table.h"

#include <optional>
#include <vector>

namespace frustumscreen::exhibit {

inline constexpr double table_gap_m = 0.012;       ///< between neighbours
inline constexpr double table_title_gap_m = 0.004; ///< between a picture and its title

/// The area where pictures may lie: clear of the prop's home and of the caption.
struct PictureArea {
    const ReadersTable& table;
    std::optional<TableArea> caption;
    bool symmetric = true; ///< false: a place may be used without its mirror image
    [[nodiscard]] bool holds(const TableArea& area) const;
};

/// The places found for a number of pictures.
struct FoundPlaces {
    double size = 0.0;  ///< of the pictures; 0: they do not all fit
    double value = 0.0; ///< `size`, less a deduction for uneven rows
    double cost = 0.0;
    std::vector<glm::dvec2> middles; ///< of picture and title together; in reading order
};
/// Entry n is for n pictures.
using FoundByCount = std::array<FoundPlaces, max_table_places + 1>;

/// The size of a picture and its title together.
[[nodiscard]] glm::dvec2 size_of_place(double picture, const glm::dvec2& title);

/// Finds the places for each number of pictures. Sizes below `min_size_m` are not tried.
[[nodiscard]] FoundByCount find_places(const PictureArea& area, const TableSetUp& set_up, double min_size_m);

/// Moves pictures on both sides of the prop to the middle between the prop and the edge.
void come_nearer_to_prop(const PictureArea& area, const glm::dvec2& whole, std::vector<glm::dvec2>& middles);

} // namespace frustumscreen::exhibit
