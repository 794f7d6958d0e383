// `frustumscreen-bake --check`: what it says of a scan, held against the scan's own text and against a bake of it.
#include "app/image/image.h"
#include "firmware_host/base/json.h"
#include "tests/programs/curator_folder.h"

#include <algorithm>
#include <set>
#include <sstream>

namespace frustumscreen::programs {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class BakeCheck : public CuratorFolder {
protected:
    void SetUp() override {
        fs::create_directory(folder / "scans");
        put("scans/box.obj", "mtllib box.mtl\n"
                             "v 0 0 0\nv 120 0 0\nv 0 0 80\nv 0 300 0\n"
                             "vt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\n"
                             "usemtl skin\n"
                             "f 1/1 3/2 2/3\nf 1/1/1 2/2/1 4/3/1\nf 1/1 4/2 3/3\nf 2/1 3/2 4/3\n");
        put("scans/box.mtl", "newmtl skin\nmap_Kd skin.png\n");
        image::Image8 picture(32, 16, {200, 120, 60, 255});
        picture.at(3, 3) = {10, 10, 200, 255};
        ASSERT_TRUE(write_file(folder / "scans/skin.png", image::encode_png(picture)));
    }
    [[nodiscard]] int check(const std::string& arguments) const {
        return run("frustumscreen-bake --check " + arguments);
    }
    [[nodiscard]] Json checked(const std::string& arguments, int status = 0) const {
        EXPECT_EQ(check(arguments + " --json"), status) << text("err.txt");
        return Json::parse(text("out.txt"))["scans"];
    }
    [[nodiscard]] std::vector<std::string> lines_of(const std::string& file) const {
        std::istringstream stream(text(file));
        std::vector<std::string> lines;
        for (std::string line; std::getline(stream, line);) {
            lines.push_back(line);
        }
        return lines;
    }
    /// Names of all files of the folder, without what the programs said.
    [[nodiscard]] std::set<std::string> files() const {
        std::set<std::string> names;
        for (const auto& entry : fs::recursive_directory_iterator(folder)) {
            names.insert(entry.path().lexically_relative(folder).string());
        }
        names.erase("out.txt");
        names.erase("err.txt");
        return names;
    }
};

TEST_F(BakeCheck, PrintsTheContentsOfOneScan) {
    const std::set<std::string> before = files();
    ASSERT_EQ(check("scans/box.obj"), 0) << text("err.txt");
    const std::string said = text("out.txt");
    EXPECT_TRUE(said.starts_with("scans/box.obj: can be baked\n")) << said;
    for (const char* line :
         {"  format          OBJ\n", "  triangles       4\n", "  vertices        4\n",
          "  pictures        32x16\n", "  materials       1\n", "  vertex colours  no\n",
          "  normals         yes\n", "  extents         120 x 300 x 80\n", "  unit, guessed   mm\n",
          "  pack, about     ", "  shown, about    ", "  lost            nothing\n"}) {
        EXPECT_NE(said.find(line), std::string::npos) << line << said;
    }
    EXPECT_EQ(text("err.txt"), "");
    EXPECT_EQ(files(), before) << "nothing is written";
}

TEST_F(BakeCheck, SummaryAndLossesMatchTheBake) {
    put("scans/bare.obj", "mtllib nowhere.mtl\nwhatever 3\nl 1 2\n" + text("scans/box.obj"));
    put_jug("jug", "[[texts]]\nlanguage = \"en\"\ntitle = \"Jug\"\ndescription = \"A jug.\"\n"
                   "[[hotspots]]\npoint = [0.33, 0.33, 0.34]\nlabels = { de = \"Henkel\" }\n");
    put_recording("jug/recordings/en/other.wav");
    std::size_t losses = 0;
    for (const char* scan : {"scans/box.obj", "scans/bare.obj", "jug"}) {
        const Json one = checked(fmt::format("{} --size 16", scan))[0];
        EXPECT_TRUE(one["can_be_baked"]);
        ASSERT_EQ(run(fmt::format("frustumscreen-bake {} -o x.fspack --size 16 --json", scan)), 0)
            << text("err.txt");
        const Json baked = Json::parse(text("out.txt"));
        EXPECT_EQ(one["lost"], baked["lost"]) << scan;
        losses += one["lost"].size();
        ASSERT_EQ(baked["scan"].size(), 11U);
        for (const auto& [key, value] : baked["scan"].items()) {
            EXPECT_EQ(one[key], value) << scan << " " << key;
        }
        for (const Json& guess : one["guessed"]) {
            EXPECT_NE(std::find(baked["guessed"].begin(), baked["guessed"].end(), guess),
                      baked["guessed"].end());
        }
    }
    EXPECT_GE(losses, 5U);
}

TEST_F(BakeCheck, PrintsAnAlignedTableOfAFolderWithErrorsInline) {
    put("scans/cut.stl", std::string(90, 'x'));
    put("scans/a long name with blanks and \xC3\xBC.obj",
        "v 0 0 0\nv 1.5 0 0\nv 0 0 1\nv 0 1 0\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    put("scans/notes/readme.txt", "no scan");
    put_jug("scans/jug", "siez = 3\n");
    ASSERT_EQ(check("scans"), 1) << text("err.txt");
    EXPECT_EQ(text("err.txt"), "");
    const std::vector<std::string> lines = lines_of("out.txt");
    ASSERT_EQ(lines.size(), 7U) << text("out.txt");
    // The first scan's name has a letter of two bytes.
    const std::string& heading = lines[0];
    const std::string& first = lines[1];
    const std::string& box = lines[2];
    EXPECT_TRUE(first.starts_with("scans/a long name with blanks and \xC3\xBC.obj  OBJ")) << first;
    EXPECT_EQ(box.find("OBJ"), heading.find("format"));
    EXPECT_EQ(first.find("OBJ"), heading.find("format") + 1);
    const std::size_t end = heading.find("triangles") + std::string("triangles").size();
    EXPECT_EQ(box.substr(end - 2, 2), " 4");
    EXPECT_EQ(first.substr(end - 1, 2), " 4");
    EXPECT_EQ(box.find("120 x 300 x 80"), heading.find("extents"));
    EXPECT_EQ(box.size(), heading.size()) << "the last column is aligned to the right";
    EXPECT_TRUE(lines[3].starts_with("scans/cut.stl")) << lines[3];
    EXPECT_NE(lines[3].find("  cannot be baked: the file ends too early"), std::string::npos) << lines[3];
    EXPECT_NE(lines[4].find("  cannot be baked: scans/jug/artifact.toml:3: siez"), std::string::npos)
        << lines[4];
    EXPECT_EQ(lines[5], "4 scans: 2 can be baked, 2 cannot");
    EXPECT_EQ(lines[6], "Skipped folders without an artifact.toml: notes");
}

TEST_F(BakeCheck, TheStatusIsZeroOneOrTwo) {
    EXPECT_EQ(check("scans/box.obj scans/box.obj"), 0);
    EXPECT_NE(text("out.txt").find("2 scans: 2 can be baked\n"), std::string::npos) << text("out.txt");
    EXPECT_EQ(check("scans/box.obj nowhere.obj"), 1);
    EXPECT_NE(text("out.txt").find("nowhere.obj    cannot be baked: "), std::string::npos) << text("out.txt");
    EXPECT_EQ(check("nowhere.obj"), 1);
    EXPECT_EQ(text("out.txt"), "");
    EXPECT_EQ(count("err.txt", "\n"), 1U) << text("err.txt");
    put("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 1 2\nf 1 1 1\n");
    EXPECT_EQ(checked("flat.obj", 1)[0]["id"], "bake.degenerate");
    put("bare.obj", "mtllib nowhere.mtl\n" + text("scans/box.obj"));
    EXPECT_EQ(check("bare.obj"), 0);
    const Json strict = checked("bare.obj --strict", 1)[0];
    EXPECT_EQ(strict["id"], "bake.would_be_lost");
    EXPECT_EQ(strict["format"], "OBJ") << "it was read all the same";
    fs::create_directory(folder / "empty");
    EXPECT_EQ(checked("empty", 1)[0]["id"], "check.no_scan");
    EXPECT_EQ(check(""), 2);
    EXPECT_EQ(text("err.txt"), "frustumscreen-bake: FILE, a scan or a folder of scans, is required; "
                               "frustumscreen-bake --help says more\n");
    EXPECT_EQ(check("scans/box.obj --size 3"), 2);
}

} // namespace
} // namespace frustumscreen::programs
