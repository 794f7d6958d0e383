#include "assets_baked/bake/loaders/draco_counts.h"

#include <cstring>

namespace frustumscreen::bake {

namespace {

/// The best packing seen in practice is about 20 faces a byte (a flat, regular grid); a much higher count is
/// false.
constexpr std::uint64_t max_faces_per_byte = 1024;
constexpr int max_metadata_levels = 8;

class Cursor {
public:
    Cursor(ByteView bytes, const std::string& place) : bytes_(bytes), place_(place) {}

    template <typename T> T take() {
        need(sizeof(T));
        const T value = load_little<T>(bytes_, position_);
        position_ += sizeof(T);
        return value;
    }
    std::uint64_t take_variable() {
        std::uint64_t value = 0;
        for (unsigned shift = 0; shift < 35; shift += 7) {
            const auto byte = take<std::uint8_t>();
            value |= static_cast<std::uint64_t>(byte & 0x7fU) << shift;
            if ((byte & 0x80U) == 0) {
                return value;
            }
        }
        refuse_damage("{}: the Draco stream is damaged near byte {}", place_, position_);
    }
    void skip(std::uint64_t count) {
        need(count);
        position_ += static_cast<std::size_t>(count);
    }

private:
    void need(std::uint64_t count) const {
        if (count > bytes_.size() - position_) {
            refuse_cut_short("{}: the Draco stream ends at byte {}", place_, bytes_.size());
        }
    }

    ByteView bytes_;
    const std::string& place_;
    std::size_t position_ = 0;
};

void skip_metadata(Cursor& cursor, int level, const std::string& place) {
    if (level > max_metadata_levels) {
        refuse_damage("{}: the Draco stream's metadata are nested deeper than {} levels", place,
                      max_metadata_levels);
    }
    for (std::uint64_t entries = cursor.take_variable(); entries > 0; --entries) {
        cursor.skip(cursor.take<std::uint8_t>());
        cursor.skip(cursor.take_variable());
    }
    for (std::uint64_t children = cursor.take_variable(); children > 0; --children) {
        cursor.skip(cursor.take<std::uint8_t>());
        skip_metadata(cursor, level + 1, place);
    }
}

void skip_all_metadata(Cursor& cursor, const std::string& place) {
    for (std::uint64_t attributes = cursor.take_variable(); attributes > 0; --attributes) {
        (void)cursor.take_variable();
        skip_metadata(cursor, 0, place);
    }
    skip_metadata(cursor, 0, place);
}

} // namespace

DracoCounts check_draco_stream(ByteView stream, const std::string& place) {
    if (stream.size() < 11 || std::memcmp(stream.data(), "DRACO", 5) != 0) {
        refuse_damage("{}: is not a Draco stream", place);
    }
    Cursor cursor(stream, place);
    cursor.skip(5);
    const auto major = cursor.take<std::uint8_t>();
    const auto minor = cursor.take<std::uint8_t>();
    const auto geometry = cursor.take<std::uint8_t>();
    const auto method = cursor.take<std::uint8_t>();
    const auto flags = cursor.take<std::uint16_t>();
    if (major != 2 || minor != 2) {
        refuse("mesh.draco_version",
               "it is packed with Draco {1}.{2}; only 2.2 can be read: export it with a newer program, or "
               "without Draco ({0})",
               place, major, minor);
    }
    if (geometry != 1 || method > 1) {
        refuse_damage("{}: the Draco stream is not a triangle mesh", place);
    }
    if ((flags & 0x8000U) != 0) {
        skip_all_metadata(cursor, place);
    }
    DracoCounts counts;
    const bool edge_breaker = method == 1;
    if (edge_breaker) {
        cursor.skip(1); // kind of traversal
        counts.points = cursor.take_variable();
        counts.faces = cursor.take_variable();
    } else {
        counts.faces = cursor.take_variable();
        counts.points = cursor.take_variable();
    }
    const std::uint64_t most = stream.size() * max_faces_per_byte;
    if (counts.faces > most || counts.points > most) {
        refuse_contradiction("{}: the Draco stream of {} bytes claims {} faces and {} vertices", place,
                             stream.size(), counts.faces, counts.points);
    }
    return counts;
}

} // namespace frustumscreen::bake
