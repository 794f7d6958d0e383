// A room's code is in the namespace of its folder. The base is in `frustumscreen` itself: every room names errors and time.
#include "tests/folders.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace frustumscreen {
namespace {

namespace fs = std::filesystem;

/// The namespace of a source below app, firmware_host or assets_baked; `path` is relative to the root.
std::string namespace_of(const fs::path& path) {
    const std::vector<fs::path> parts(path.begin(), path.end());
    return parts.at(1) == "base" ? "frustumscreen" : "frustumscreen::" + parts.at(1).string();
}

bool is_declaration(const std::string& line) {
    return (line.rfind("class ", 0) == 0 || line.rfind("struct ", 0) == 0) && line.back() == ';';
}

/// The house's namespaces that a source opens, with those nested in one line; not one in which it only declares
/// another room's class.
std::vector<std::string> namespaces_in(const fs::path& file) {
    const std::string begin = "namespace ";
    std::vector<std::string> opened;
    std::ifstream text(file);
    std::string name; ///< of a namespace that the line before opens
    for (std::string line; std::getline(text, line);) {
        if (!name.empty() && !is_declaration(line)) {
            opened.push_back(name);
        }
        const bool opens = line.rfind(begin + "frustumscreen", 0) == 0;
        name = opens ? line.substr(begin.size(), line.find(" {") - begin.size()) : "";
    }
    return opened;
}

bool is_or_is_in(const std::string& name, const std::string& outer) {
    return name == outer || (outer != "frustumscreen" && name.rfind(outer + "::", 0) == 0);
}

TEST(Layers, EveryRoomHasTheNamespaceOfItsFolder) {
    const fs::path root = source_dir();
    std::size_t looked_at = 0;
    for (const std::string folder : {"app", "firmware_host", "assets_baked"}) {
        for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
            if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") {
                continue;
            }
            const fs::path path = fs::relative(entry.path(), root);
            for (const std::string& name : namespaces_in(entry.path())) {
                ++looked_at;
                EXPECT_TRUE(is_or_is_in(name, namespace_of(path)))
                    << path << " is in " << name << " and not in " << namespace_of(path);
            }
        }
    }
    EXPECT_GT(looked_at, 1000U);
}

} // namespace
} // namespace frustumscreen
