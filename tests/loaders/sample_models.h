/// Small models of every format, written by hand or by the libraries' own encoders.
#pragma once

#include <string>
#include <vector>

namespace frustumscreen::testing {

struct SampleModel {
    std::string name; ///< with its extension
    std::string bytes;
};

/// Vertices of a grid of `n` x `n` squares on a paraboloid over [0, 1] x [0, 1].
std::vector<float> grid_positions(int n);
std::vector<unsigned int> grid_indices(int n);

/// KHR_draco_mesh_compression of that grid, edge breaker or sequential.
std::string draco_glb(int n, bool edge_breaker);
/// EXT_meshopt_compression of that grid: a vertex view with the exponential filter, a triangle view, a
/// fallback buffer without data.
std::string meshopt_glb(int n);

/// At least one of each format and of each compression; all are valid.
std::vector<SampleModel> sample_models();

} // namespace frustumscreen::testing
