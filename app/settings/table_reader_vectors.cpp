/// TableReader: points, vectors and transforms.
#include "app/settings/found_value.h"
#include "app/settings/table_reader.h"

#include <fmt/format.h>

#include <algorithm>

namespace frustumscreen::settings {

bool TableReader::point_of(const toml::array& array, const std::string& name, glm::dvec3& value,
                           const Range& range) {
    for (int i = 0; i < 3; ++i) {
        if (!number_of(*array.get(static_cast<std::size_t>(i)), fmt::format("{}[{}]", name, i), value[i],
                       range)) {
            return false;
        }
    }
    return true;
}

void TableReader::vector(std::string_view key, glm::dvec3& value, const Range& range,
                         std::string_view /*sentence*/) {
    const toml::array* array = list_of(key, 3, 3, "3 numbers, [x, y, z]");
    glm::dvec3 read(0.0);
    if (array != nullptr && point_of(*array, full_name(key), read, range)) {
        value = read;
    }
}

void TableReader::pair(std::string_view key, glm::dvec2& value, const Range& range) {
    const toml::array* array = list_of(key, 2, 2, "2 numbers, [x, y]");
    glm::dvec2 read(0.0);
    const std::string name = full_name(key);
    if (array != nullptr && number_of(*array->get(0), fmt::format("{}[0]", name), read.x, range) &&
        number_of(*array->get(1), fmt::format("{}[1]", name), read.y, range)) {
        value = read;
    }
}

void TableReader::points(std::string_view key, std::span<glm::dvec3> values, const Range& range,
                         std::string_view /*sentence*/) {
    const std::string allowed = fmt::format("{} points, each of 3 numbers, [x, y, z]", values.size());
    const toml::array* array = list_of(key, values.size(), values.size(), allowed);
    if (array == nullptr) {
        return;
    }
    std::vector<glm::dvec3> read(values.size());
    for (std::size_t k = 0; k < values.size(); ++k) {
        const toml::array* point = array->get(k)->as_array();
        if (point == nullptr || point->size() != 3) {
            refuse("settings.points", key,
                   fmt::format("has {} as number {}; allowed is a list of {}", found(*array->get(k)), k + 1,
                               allowed));
            return;
        }
        if (!point_of(*point, fmt::format("{}[{}]", full_name(key), k), read[k], range)) {
            return;
        }
    }
    std::copy(read.begin(), read.end(), values.begin());
}

void TableReader::rigid(std::string_view key, geometry::RigidTransform& value, const Range& range,
                        std::string_view /*sentence*/) {
    glm::dmat4 matrix = value.matrix();
    read_matrix(key, matrix, range);
    if (const auto rigid = geometry::rigid_from_matrix(matrix)) {
        value = *rigid;
    } else if (geometry::rigid_from_matrix(glm::transpose(matrix))) {
        refuse("settings.row_by_row", key,
               "is written row by row; allowed is column by column: numbers 13 to 15 are the translation in "
               "metres");
    } else {
        refuse("settings.no_rigid_transform", key,
               "scales, shears, mirrors or has a last row other than 0 0 0 1; allowed is a rotation and a "
               "translation in metres, column by column");
    }
}

void TableReader::read_matrix(std::string_view key, glm::dmat4& value, const Range& range) {
    const toml::array* array = list_of(key, 16, 16, "16 numbers, column by column");
    if (array == nullptr) {
        return;
    }
    glm::dmat4 read(0.0);
    for (int i = 0; i < 16; ++i) {
        if (!number_of(*array->get(static_cast<std::size_t>(i)), fmt::format("{}[{}]", full_name(key), i),
                       read[i / 4][i % 4], range)) {
            return;
        }
    }
    value = read;
}

} // namespace frustumscreen::settings
