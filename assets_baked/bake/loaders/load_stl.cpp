#include "assets_baked/bake/loaders/load_stl.h"

#include "assets_baked/bake/loaders/mesh_assembly.h"
#include "assets_baked/bake/loaders/text.h"
#include "assets_baked/bake/loaders/vertex_numbers.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/printable.h"
#include "firmware_host/base/trimmed.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <set>
#include <string>

namespace frustumscreen::bake {

namespace {

constexpr std::size_t header_size = 84;
constexpr std::size_t facet_size = 50;

bool is_word(std::string_view word, std::string_view lower) {
    return std::equal(word.begin(), word.end(), lower.begin(), lower.end(), [](char a, char b) {
        return (a >= 'A' && a <= 'Z' ? static_cast<char>(a + ('a' - 'A')) : a) == b;
    });
}

/// The bits of a position; -0 counts as 0.
VertexNumbers::Key key_of(const glm::vec3& p) {
    return {std::bit_cast<std::uint32_t>(p.x + 0.0F), std::bit_cast<std::uint32_t>(p.y + 0.0F),
            std::bit_cast<std::uint32_t>(p.z + 0.0F)};
}

SourceMesh load_binary(ByteView file, ModelFiles& files) {
    if (file.size() < header_size) {
        refuse_cut_short("a binary STL begins with {} bytes, the file has {}", header_size, file.size());
    }
    const std::uint64_t count = load_little<std::uint32_t>(file, header_size - 4);
    if (count > (file.size() - header_size) / facet_size) {
        refuse_cut_short("{} triangles are declared, {} are there", count,
                         (file.size() - header_size) / facet_size);
    }
    const bool has_colours = as_text(file.subspan(0, header_size)).find("COLOR=") != std::string_view::npos;
    if (has_colours) {
        files.notes.lost("the colours: those of STL files are not read; export it as PLY, OBJ or glTF");
    }
    MeshAssembly mesh('z');
    mesh.expect_triangles(static_cast<std::size_t>(count));
    std::size_t with_attribute = 0;
    VertexNumbers numbers; // an STL repeats each vertex about six times
    for (std::size_t facet = 0; facet < count; ++facet) {
        if (facet % (std::size_t{1} << 16U) == 0) {
            files.passed(header_size + facet * facet_size);
        }
        const ByteView corners = file.subspan(header_size + facet * facet_size + 12, 36);
        std::array<std::uint32_t, 3> vertices{};
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::vec3 p(load_little<float>(corners, i * 12), load_little<float>(corners, i * 12 + 4),
                              load_little<float>(corners, i * 12 + 8));
            const auto [vertex, is_new] = numbers.number_of(key_of(p));
            if (is_new) {
                (void)mesh.add_vertex(glm::dvec3(p), "vertex", facet * 3 + i);
            }
            vertices[i] = vertex;
        }
        mesh.add_triangle(vertices[0], vertices[1], vertices[2], 0);
        with_attribute +=
            load_little<std::uint16_t>(file, header_size + facet * facet_size + 48) != 0 ? 1 : 0;
    }
    if (with_attribute > 0 && !has_colours) {
        files.notes.lost(
            "the numbers beside {}, which may be colours: those of STL files are not read; export it "
            "as PLY, OBJ or glTF",
            counted(with_attribute, "triangle", "triangles"));
    }
    return mesh.finish();
}

double coordinate(WordReader& words) {
    const std::string_view word = words.next();
    const std::optional<double> number = number_from(word);
    if (word.empty()) {
        refuse_cut_short("line {}: the text ends inside a facet", words.line());
    }
    if (!number) {
        refuse_damage("line {}: a number is expected, not \"{}\"", words.line(), word.substr(0, 40));
    }
    return *number;
}

/// Words that only frame the vertices; a normal's numbers follow from them too.
bool is_frame_word(std::string_view word) {
    static constexpr std::array words = {"facet", "normal", "outer", "loop", "endfacet"};
    return std::any_of(words.begin(), words.end(), [&](const char* each) { return is_word(word, each); }) ||
           number_from(word).has_value();
}

/// Only `vertex`, `endloop` and `endsolid` matter.
SourceMesh load_ascii(std::string_view text, ModelFiles& files) {
    WordReader words(text);
    (void)words.next();
    (void)words.rest_of_line(); // the solid's name
    MeshAssembly mesh('z');
    std::size_t in_loop = 0;
    bool ended = false;
    std::set<std::string> unknown;
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
        if (is_word(word, "vertex")) {
            const double x = coordinate(words);
            const double y = coordinate(words);
            const double z = coordinate(words);
            (void)mesh.add_vertex({x, y, z}, "vertex", mesh.positions().size());
            ++in_loop;
        } else if (is_word(word, "endloop")) {
            if (in_loop != 3) {
                refuse_damage("line {}: the facet has {} vertices, 3 are expected", words.line(), in_loop);
            }
            const auto end = static_cast<std::uint32_t>(mesh.positions().size());
            mesh.add_triangle(end - 3, end - 2, end - 1, 0);
            in_loop = 0;
            if (end % (3U << 16U) == 0) {
                files.passed(words.position());
            }
        } else if (is_word(word, "endsolid") || is_word(word, "solid")) {
            ended = is_word(word, "endsolid");
            (void)words.rest_of_line();
        } else if (!is_frame_word(word)) {
            unknown.emplace(word.substr(0, 40));
        }
    }
    if (!unknown.empty()) {
        files.notes.lost("words that the STL format does not have: {}",
                         printable(fmt::format("{}", fmt::join(unknown, ", "))));
    }
    if (!ended || in_loop != 0) {
        refuse_cut_short("line {}: the text ends without \"endsolid\"", words.line());
    }
    return mesh.finish();
}

} // namespace

bool has_length_of_binary_stl(ByteView file) {
    return file.size() >= header_size &&
           file.size() ==
               header_size + facet_size * std::uint64_t{load_little<std::uint32_t>(file, header_size - 4)};
}

SourceMesh load_stl(ByteView file, ModelFiles& files) {
    const std::string_view text = trimmed(as_text(file.subspan(0, std::min<std::size_t>(file.size(), 1024))));
    const bool is_text = text.size() >= 5 && is_word(text.substr(0, 5), "solid");
    return is_text && !has_length_of_binary_stl(file) ? load_ascii(as_text(file), files)
                                                      : load_binary(file, files);
}

} // namespace frustumscreen::bake
