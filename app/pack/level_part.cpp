#include "app/pack/binary_parts.h"
#include "app/pack/check_pack.h"
#include "app/pack/container/limits.h"
#include "app/pack/relief_texel.h"
#include "firmware_host/base/byte_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>

namespace frustumscreen::pack {

namespace {

constexpr std::array<char, 4> level_magic{'F', 'S', 'L', 'V'};
constexpr std::uint32_t level_version = 1;
constexpr std::size_t header_bytes = 24;
constexpr std::size_t cluster_bytes = 52;

/// A relief level's vertex as stored.
struct StoredTexel {
    std::uint16_t chart = 0, x = 0, y = 0;
};
static_assert(sizeof(StoredTexel) == 6);

/// The texel whose centre has this code; nothing if the code differs from the nearest centre's by more than its
/// rounding.
std::optional<int> texel_of(std::uint16_t code, int width) {
    const int texel = static_cast<int>(std::floor(code / 65535.0 * width));
    if (texel < 0 || texel >= width || std::abs(uv_code(texel, width) - code) > 1) {
        return std::nullopt;
    }
    return texel;
}

/// The chart of each texel of the atlas; charts are disjoint.
image::Image<std::int32_t> chart_of_texels(const ReliefAtlas& relief) {
    image::Image<std::int32_t> owner(relief.relief.width, relief.relief.height, -1);
    for (std::size_t k = 0; k < relief.charts.size(); ++k) {
        const ReliefChart& chart = relief.charts[k];
        for (int y = chart.y; y < chart.y + chart.height; ++y) {
            for (int x = chart.x; x < chart.x + chart.width; ++x) {
                owner.at(x, y) = static_cast<std::int32_t>(k);
            }
        }
    }
    return owner;
}

/// True if two positions are equal, except for the rounding of their codes and of 32-bit arithmetic.
bool same_place(const PackVertex& a, const PackVertex& b, const glm::dvec3& box_size) {
    constexpr double codes = 2.0;
    constexpr double rounding_box = 1e-6;
    for (int axis = 0; axis < 3; ++axis) {
        const auto k = static_cast<std::size_t>(axis);
        if (std::abs(a.position[k] - b.position[k]) > codes + rounding_box / box_size[axis] * 65535.0) {
            return false;
        }
    }
    return true;
}

Result<std::vector<StoredTexel>> store_texels(const PackLevel& level, const ReliefAtlas& relief,
                                              const glm::dvec3& box_size) {
    const image::Image<std::int32_t> owner = chart_of_texels(relief);
    std::vector<StoredTexel> texels;
    texels.reserve(level.vertices.size());
    for (std::size_t k = 0; k < level.vertices.size(); ++k) {
        const PackVertex& vertex = level.vertices[k];
        const std::optional<int> x = texel_of(vertex.uv[0], relief.relief.width);
        const std::optional<int> y = texel_of(vertex.uv[1], relief.relief.height);
        if (!x || !y || owner.at(*x, *y) < 0 || relief.relief.at(*x, *y) == empty_relief) {
            return bad_input("level.vertex_off_texel",
                             "vertex {} is not at the centre of a filled texel of a chart", k);
        }
        const auto chart = static_cast<std::size_t>(owner.at(*x, *y));
        const PackVertex there = relief_vertex(relief, relief.charts[chart], *x, *y, box_size);
        if (!same_place(vertex, there, box_size)) {
            return bad_input("level.vertex_off_relief",
                             "vertex {} is not where the relief puts its texel ({}, {})", k, *x, *y);
        }
        texels.push_back({static_cast<std::uint16_t>(chart), static_cast<std::uint16_t>(*x),
                          static_cast<std::uint16_t>(*y)});
    }
    return texels;
}

Result<std::vector<PackVertex>> vertices_of(const std::vector<StoredTexel>& texels, const ReliefAtlas& relief,
                                            const glm::dvec3& box_size) {
    std::vector<PackVertex> vertices;
    vertices.reserve(texels.size());
    for (std::size_t k = 0; k < texels.size(); ++k) {
        const StoredTexel& texel = texels[k];
        if (texel.chart >= relief.charts.size()) {
            return bad_input("level.vertex_chart", "vertex {} lies in chart {}, the relief has {}", k,
                             texel.chart, relief.charts.size());
        }
        const ReliefChart& chart = relief.charts[texel.chart];
        const bool inside = texel.x >= chart.x && texel.x < chart.x + chart.width && texel.y >= chart.y &&
                            texel.y < chart.y + chart.height;
        if (!inside || relief.relief.at(texel.x, texel.y) == empty_relief) {
            return bad_input("level.vertex_texel", "vertex {} is texel ({}, {}), {} chart {}", k, texel.x,
                             texel.y, inside ? "an empty one of" : "outside", texel.chart);
        }
        vertices.push_back(relief_vertex(relief, chart, texel.x, texel.y, box_size));
    }
    return vertices;
}

void append_cluster(Bytes& bytes, const PackCluster& cluster) {
    append(bytes, cluster.first_index);
    append(bytes, cluster.index_count);
    for (int axis = 0; axis < 3; ++axis) {
        append(bytes, cluster.centre[axis]);
    }
    append(bytes, cluster.radius);
    for (int axis = 0; axis < 3; ++axis) {
        append(bytes, cluster.cone_apex[axis]);
    }
    for (int axis = 0; axis < 3; ++axis) {
        append(bytes, cluster.cone_axis[axis]);
    }
    append(bytes, cluster.cone_cutoff);
}

glm::vec3 read_vector(ByteReader& reader) {
    glm::vec3 v(0.0F);
    for (int axis = 0; axis < 3; ++axis) {
        v[axis] = reader.read<float>();
    }
    return v;
}

PackCluster read_cluster(ByteReader& reader) {
    PackCluster cluster;
    cluster.first_index = reader.read<std::uint32_t>();
    cluster.index_count = reader.read<std::uint32_t>();
    cluster.centre = read_vector(reader);
    cluster.radius = reader.read<float>();
    cluster.cone_apex = read_vector(reader);
    cluster.cone_axis = read_vector(reader);
    cluster.cone_cutoff = reader.read<float>();
    return cluster;
}

struct Header {
    bool relief = false;
    std::uint32_t vertices = 0, indices = 0, clusters = 0;
};

/// Checks that the counts fit the limits and exactly fill the part.
Result<Header> read_header(std::span<const std::byte> bytes, std::uint64_t part_bytes) {
    if (bytes.size() < header_bytes ||
        std::memcmp(bytes.data(), level_magic.data(), level_magic.size()) != 0) {
        return bad_input("level.no_magic", "it does not begin as a level does (FSLV)");
    }
    ByteReader reader(bytes.subspan(level_magic.size()));
    const auto version = reader.read<std::uint32_t>();
    const auto kind = reader.read<std::uint32_t>();
    if (version != level_version || kind > 1) {
        return bad_input("level.version",
                         "its triangles have version {} and kind {}, allowed are {} and 0 or 1", version,
                         kind, level_version);
    }
    Header header{.relief = kind == 1, .vertices = 0, .indices = 0, .clusters = 0};
    header.vertices = reader.read<std::uint32_t>();
    header.indices = reader.read<std::uint32_t>();
    header.clusters = reader.read<std::uint32_t>();
    const std::uint64_t needed =
        std::uint64_t{header.clusters} * cluster_bytes +
        std::uint64_t{header.indices} * sizeof(std::uint32_t) +
        std::uint64_t{header.vertices} * (header.relief ? sizeof(StoredTexel) : sizeof(PackVertex));
    if (header.vertices > max_vertices || header.indices > max_indices || header.clusters > max_clusters ||
        needed != part_bytes - header_bytes) {
        return bad_input("level.size", "{} vertices, {} indices, {} clusters need {} bytes, it has {}",
                         header.vertices, header.indices, header.clusters, needed, part_bytes - header_bytes);
    }
    return header;
}

} // namespace

Result<Bytes> encode_level(const PackLevel& level, const ReliefAtlas& relief, const glm::dvec3& box_size) {
    const bool is_relief = level.technique == LevelTechnique::Relief;
    Bytes bytes;
    for (const char c : level_magic) {
        append(bytes, c);
    }
    append(bytes, level_version);
    append(bytes, std::uint32_t{is_relief ? 1U : 0U});
    append(bytes, static_cast<std::uint32_t>(level.vertices.size()));
    append(bytes, static_cast<std::uint32_t>(level.indices.size()));
    append(bytes, static_cast<std::uint32_t>(level.clusters.size()));
    for (const PackCluster& cluster : level.clusters) {
        append_cluster(bytes, cluster);
    }
    append_all(bytes, level.indices);
    if (!is_relief) {
        append_all(bytes, level.vertices);
        return bytes;
    }
    TRY(const std::vector<StoredTexel> texels, store_texels(level, relief, box_size));
    append_all(bytes, texels);
    return bytes;
}

Result<PackLevel> decode_level(std::span<const std::byte> bytes, const ReliefAtlas& relief,
                               const glm::dvec3& box_size) {
    TRY(const Header header, read_header(bytes, bytes.size()));
    PackLevel level;
    level.technique = header.relief ? LevelTechnique::Relief : LevelTechnique::Mesh;
    ByteReader reader(bytes.subspan(header_bytes));
    level.clusters.reserve(header.clusters);
    for (std::uint32_t k = 0; k < header.clusters; ++k) {
        level.clusters.push_back(read_cluster(reader));
    }
    level.indices = reader.read_all<std::uint32_t>(header.indices);
    if (!header.relief) {
        level.vertices = reader.read_all<PackVertex>(header.vertices);
        return level;
    }
    TRY(level.vertices, vertices_of(reader.read_all<StoredTexel>(header.vertices), relief, box_size));
    return level;
}

/// Size of the next item; 0: nothing is left.
std::size_t LevelScan::next_bytes() const {
    return !has_header_                 ? header_bytes
           : clusters_seen_ < clusters_ ? cluster_bytes
           : indices_seen_ < indices_   ? sizeof(std::uint32_t)
           : vertices_seen_ < vertices_ ? (is_relief_ ? sizeof(StoredTexel) : sizeof(PackVertex))
                                        : 0;
}

void LevelScan::take(std::span<const std::byte> item) {
    ByteReader reader(item);
    if (!has_header_) {
        const Result<Header> header = read_header(item, part_bytes_);
        if (!header) {
            fault_ = header.error();
            return;
        }
        has_header_ = true;
        is_relief_ = header->relief;
        vertices_ = header->vertices;
        indices_ = header->indices;
        clusters_ = header->clusters;
    } else if (clusters_seen_ < clusters_) {
        const PackCluster cluster = read_cluster(reader);
        if (const Result<void> good = check_cluster(cluster, clusters_seen_, covered_); !good) {
            fault_ = good.error();
        }
        covered_ += cluster.index_count;
        ++clusters_seen_;
    } else if (indices_seen_ < indices_) {
        ++indices_seen_;
        if (const auto index = reader.read<std::uint32_t>(); index >= vertices_) {
            fault_ =
                bad_input("level.scan_index", "an index is {}, the level has {} vertices", index, vertices_)
                    .value();
        }
    } else {
        ++vertices_seen_;
        if (!is_relief_ && reader.read<PackVertex>().reserved != 0) {
            fault_ =
                bad_input("level.scan_reserved", "a vertex has its reserved bytes set; allowed is 0").value();
        }
    }
}

void LevelScan::add(std::span<const std::byte> bytes) {
    while (!bytes.empty() && !fault_) {
        const std::size_t wanted = next_bytes();
        const std::size_t more = std::min(wanted - begun_.size(), bytes.size());
        if (begun_.empty() && more == wanted) {
            take(bytes.first(wanted));
        } else {
            begun_.insert(begun_.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(more));
            if (begun_.size() == wanted) {
                take(begun_);
                begun_.clear();
            }
        }
        bytes = bytes.subspan(more);
    }
}

Result<void> LevelScan::finish(LevelTechnique technique, std::uint64_t triangles,
                               std::uint64_t vertices) const {
    if (fault_) {
        return tl::unexpected<Error>(*fault_);
    }
    if (!has_header_) {
        return bad_input("level.scan_magic", "it does not begin as a level does (FSLV)");
    }
    if (covered_ != indices_ || indices_ == 0) {
        return bad_input("level.scan_clusters", "the clusters cover {} indices, the level has {}", covered_,
                         indices_);
    }
    if (is_relief_ != (technique == LevelTechnique::Relief) || indices_ != 3 * triangles ||
        vertices_ != vertices) {
        return bad_input("level.scan_triangles",
                         "it holds other triangles than the manifest says; the pack is altered");
    }
    return {};
}

} // namespace frustumscreen::pack
