/// Pareto fronts of cost (x) against error (y), both to be small, of one artifact and of many.
///
/// Source   the median attainment surface: Grunert da Fonseca, Fonseca & Hall 2001, 'Inferential performance
///          assessment of stochastic optimisers and the attainment function'.
/// Threads  pure; any.
#pragma once

#include <glm/glm.hpp>

#include <span>
#include <vector>

namespace frustumscreen {

/// The points that no other is left of and below, by ascending cost; of equal ones the first.
[[nodiscard]] std::vector<glm::dvec2> pareto_front(std::span<const glm::dvec2> points);

/// For each cost at which it changes, the least error that at least half of the artifacts reach at no more
/// than that cost. One set of points each artifact; an empty one reaches nothing.
[[nodiscard]] std::vector<glm::dvec2> median_attainment(std::span<const std::vector<glm::dvec2>> artifacts);

} // namespace frustumscreen
