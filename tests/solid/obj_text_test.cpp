// Plain OBJ text: what is read of it, and what is said of the rest.
#include "app/solid/obj_text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace frustumscreen::solid {
namespace {

using Corners = std::vector<std::uint32_t>;

/// Four vertices in six lines.
const std::string four = "v 0 0 0\nv 100 0 0\nv 0 100 0\n\n# the tip\nv 0 0 100\n";

ObjText parsed(const std::string& text, LengthUnit unit = LengthUnit::Millimetre) {
    const Result<ObjText> obj = parse_obj(text, unit);
    EXPECT_TRUE(obj.has_value()) << (obj ? "" : obj.error().message);
    return obj.value_or(ObjText{});
}

/// Expects the text to be refused by this id, with these words in the sentence.
void expect_refused(const std::string& text, std::string_view id, const std::vector<std::string>& words) {
    const Result<ObjText> obj = parse_obj(text, LengthUnit::Millimetre);
    ASSERT_FALSE(obj.has_value()) << text.substr(0, 200);
    EXPECT_EQ(obj.error().id, id) << obj.error().message;
    for (const std::string& word : words) {
        EXPECT_NE(obj.error().message.find(word), std::string::npos) << word << ": " << obj.error().message;
    }
}

TEST(ObjText, VerticesAreConvertedToMetres) {
    const std::string text = "v 10 -20.5 +3e1\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    EXPECT_EQ(parsed(text).mesh.vertices.front(), glm::dvec3(0.01, -0.0205, 0.03));
    EXPECT_EQ(parsed(text, LengthUnit::Metre).mesh.vertices.front(), glm::dvec3(10, -20.5, 30));
}

TEST(ObjText, ParsesFourCornerFormsAndNegativeIndices) {
    for (const char* face :
         {"f 1 2 4", "f 1/7 2/8 4/9", "f 1//7 2//8 4//9", "f 1/1/1 2/2/2 4/3/3", "f -4 -3 -1",
          "f -4//-1 2 4/5/6", "  f\t+1 2   4   ", "f 1 2 4 # three corners"}) {
        const ObjText obj = parsed(four + face);
        ASSERT_EQ(obj.mesh.polygons.size(), 1U);
        EXPECT_EQ(obj.mesh.polygons[0].corners, (Corners{0, 1, 3})) << face;
        EXPECT_EQ(obj.mesh.polygons[0].number, 7U);
    }
}

TEST(ObjText, AcceptsThreeLineEndsAndContinuationLines) {
    const std::string joined = "v 0 0 0\nv 1 \\\n 0 0\nv 0 1 0\nf 1 2 \\\n3\nf \\ \n 1 2 \\\n 3\nf 1 3 2";
    for (const char* end : {"\n", "\r\n", "\r"}) {
        std::string text;
        for (const char c : joined) {
            text += c == '\n' ? std::string(end) : std::string(1, c);
        }
        const ObjText obj = parsed(text);
        EXPECT_EQ(obj.mesh.vertices.size(), 3U);
        ASSERT_EQ(obj.mesh.polygons.size(), 3U);
        EXPECT_EQ(obj.mesh.polygons[0].number, 5U);
        EXPECT_EQ(obj.mesh.polygons[1].number, 7U);
        EXPECT_EQ(obj.mesh.polygons[1].corners, (Corners{0, 1, 2}));
        EXPECT_EQ(obj.mesh.polygons[2].number, 10U);
    }
}

TEST(ObjText, CommentsDoNotContinueOntoTheNextLine) {
    const ObjText obj = parsed("\xEF\xBB\xBF# from C:\\props\\\n" + four + "f 1 2 3\n#f 1 2 4\n");
    EXPECT_EQ(obj.mesh.vertices.size(), 4U);
    EXPECT_EQ(obj.mesh.polygons.size(), 1U);
    EXPECT_TRUE(obj.notes.empty());
}

TEST(ObjText, NamesFacesAfterTheirGroups) {
    const ObjText obj =
        parsed(four + "f 1 2 3\ng left hand\nf 1 2 4\no body\nf 1 3 4\ng\nf 2 3 4\ng default\n"
                      "f 1 2 3\ng a\\b\x01#c\nf 1 2 3\n");
    std::vector<std::string> names;
    for (const Polygon& polygon : obj.mesh.polygons) {
        names.push_back(polygon.name);
    }
    EXPECT_EQ(names, (std::vector<std::string>{"", "left", "body", "", "", "a_b?#c"}));
}

TEST(ObjText, NotesEachUnknownKeywordOnce) {
    const ObjText obj =
        parsed("mtllib a.mtl\n" + four + "vn 0 0 1\nvn 1 0 0\nusemtl skin\nf 1 2 3\nvn 0 1 0\n");
    ASSERT_EQ(obj.notes.size(), 3U);
    for (const auto& [note, words] :
         {std::pair(0, "mtllib (line 1)"), {1, "vn (line 8)"}, {2, "usemtl (line 10)"}}) {
        EXPECT_NE(obj.notes[static_cast<std::size_t>(note)].find(words), std::string::npos) << obj.notes[0];
    }
    std::string many = four + "f 1 2 3\n";
    for (int k = 0; k < 1000; ++k) {
        many += fmt::format("word{}\n", k);
    }
    EXPECT_EQ(parsed(many).notes.size(), 11U);
    EXPECT_EQ(parsed("v 0 0 0 1\nv 1 0 0 255 0 0\nv 0 1 0\nf 1 2 3\n").notes.size(), 1U)
        << "weights and colours";
}

TEST(ObjText, ReportsErrorsWithTheirLine) {
    expect_refused("v 0 0\n", "prop_file.vertex", {"line 1", "this one has 2"});
    expect_refused("v 0 0 0 1 2 3 4 5\n", "prop_file.vertex", {"line 1", "this one has 8"});
    expect_refused("\nv 0 1,5 0\n", "prop_file.number", {"line 2", "\"1,5\""});
    expect_refused("v 0 0 0x10\n", "prop_file.number", {"line 1"});
    expect_refused("v 0 0 1e999\n", "prop_file.number", {"1e999"});
    expect_refused("v nan 0 0\n", "prop_file.coordinate", {"line 1", "nan"});
    expect_refused("v 0 -inf 0\n", "prop_file.coordinate", {"-inf"});
    expect_refused("v 0 0 2e9\n", "prop_file.coordinate", {"2e9"});
    expect_refused(four + "f 1 2\n", "prop_file.few_corners", {"line 7", "this one has 2"});
    expect_refused(four + "f\n", "prop_file.few_corners", {"line 7", "this one has 0"});
    for (const char* corner :
         {"a", "1.5", "1/", "1//", "1/1/", "1/a", "1/1/1/1", "//1", "1///2", "1/1.0/1"}) {
        expect_refused(four + "f 1 2 " + corner + "\n", "prop_file.corner",
                       {"line 7", fmt::format("\"{}\"", corner)});
    }
    for (const char* corner : {"0", "5", "-5", "4000000000", "-9223372036854775808"}) {
        expect_refused(four + "f 1 2 " + corner + "\n", "prop_file.no_vertex",
                       {"line 7", corner, "there are 4"});
    }
    expect_refused(four + "f 1 2 99999999999999999999\n", "prop_file.corner", {"line 7"});
    for (const char* none : {"", "\n\n", "v 1 2 3", "\\", "solid x\nfacet normal 0 0 1\n"}) {
        expect_refused(none, "prop_file.no_face", {"f 1 2 3"});
    }
}

TEST(ObjText, ReportsExceededLimits) {
    expect_refused(std::string(max_obj_bytes + 1, '\n'), "prop_file.bytes", {"1048577", "1048576"});
    expect_refused(std::string(max_obj_bytes, '\n'), "prop_file.no_face", {});
    std::string vertices;
    for (std::size_t k = 0; k <= max_vertices; ++k) {
        vertices += "v 0 0 0\n";
    }
    expect_refused(vertices, "prop_file.vertices", {"line 10001", "10000"});
    std::string faces = four;
    for (std::size_t k = 0; k <= max_polygons; ++k) {
        faces += "f 1 2 3\n";
    }
    expect_refused(faces, "prop_file.polygons", {"line 10007", "10000"});
    std::string face = "f";
    for (std::size_t k = 0; k < max_polygon_corners; ++k) {
        face += " 1";
    }
    expect_refused(four + face + " 1\n", "prop_file.face_corners", {"line 7", "1000"});
    std::string corners = four;
    for (std::size_t k = 0; k <= max_corners / max_polygon_corners; ++k) {
        corners += face + "\n";
    }
    expect_refused(corners, "prop_file.polygons", {"line 107", "100000"});
}

} // namespace
} // namespace frustumscreen::solid
