// A name in a namespace is one type. Two are undefined behaviour, of which neither compiler nor linker says anything.
#include "tests/folders.h"
#include "tests/layers/type_definitions.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace frustumscreen::tests {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

Names names_in(std::string_view text) {
    Names names;
    for (const TypeDefinition& definition : type_definitions(text)) {
        names.push_back(definition.name);
    }
    return names;
}

Names violations_of(std::string_view one, std::string_view other) {
    OneDefinition definitions;
    definitions.add("one.h", one);
    definitions.add("other.cpp", other);
    return definitions.violations();
}

/// Each of these files of a folder, named from the root.
std::vector<std::string> files_below(const std::string& folder, const std::set<std::string>& extensions) {
    const fs::path root = source_dir();
    std::vector<std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
        if (extensions.contains(entry.path().extension().string())) {
            files.push_back(fs::relative(entry.path(), root).string());
        }
    }
    return files;
}

/// Sources of tests do not count: two that are never linked together may each have a Box.
TEST(OneDefinition, HasNoViolationsInTheRepository) {
    std::vector<std::string> files = files_below("tests", {".h"});
    for (const std::string folder : {"app", "firmware_host", "assets_baked"}) {
        const std::vector<std::string> more = files_below(folder, {".h", ".cpp"});
        files.insert(files.end(), more.begin(), more.end());
    }
    EXPECT_GT(files.size(), 1000U);
    OneDefinition definitions;
    for (const std::string& file : files) {
        std::ostringstream text;
        text << std::ifstream(fs::path(source_dir()) / file).rdbuf();
        definitions.add(file, text.str());
    }
    EXPECT_EQ(definitions.violations(), Names());
}

TEST(OneDefinition, NamesTwoFilesThatDefineTheSameName) {
    EXPECT_EQ(
        violations_of("namespace a { struct Box { int x; }; }", "namespace a { enum class Box { Left }; }"),
        Names({"a::Box is defined in one.h other.cpp; rename all but one"}));
    EXPECT_EQ(violations_of("namespace a { class Box {}; }", "namespace a { using Box = int; }").size(), 1U);
    EXPECT_EQ(violations_of("using Box = long;", "typedef int Box;").size(), 1U);
    EXPECT_EQ(violations_of("template <> struct a<int> {};", "template <> struct a<int> {};").size(), 1U);
}

TEST(OneDefinition, DistinguishesNamespacesClassesAndArguments) {
    const std::string_view one = "namespace a { struct Box {}; }";
    EXPECT_EQ(violations_of(one, "namespace a::b { struct Box {}; }"), Names());
    EXPECT_EQ(
        violations_of(one, "namespace a { namespace { struct Box {}; } struct Case { struct Box {}; }; }"),
        Names());
    EXPECT_EQ(violations_of(one, "namespace a { struct Box; Box made() { struct Box {}; } }"), Names());
    EXPECT_EQ(violations_of("template <> struct a<int> {};", "template <> struct a<long> {};"), Names());
    EXPECT_EQ(violations_of("using Json = j::json;", "using Json = j::json;"), Names());
}

TEST(OneDefinition, FindsEveryKindOfDefinition) {
    EXPECT_EQ(
        names_in(
            "struct A {}; class B final : public A {}; union C {}; enum D { X }; enum class E : int { Y };"
            "template <typename T> requires(sizeof(T) > 1) struct F {}; struct [[nodiscard]] G {};"
            "struct alignas(16) H {}; using I = int; typedef unsigned long J;"),
        Names({"A", "B", "C", "D", "E", "F", "G", "H", "I", "J"}));
    EXPECT_EQ(
        names_in(
            "namespace a { inline namespace b { struct A {}; } extern \"C\" { struct B {}; } } struct C {};"),
        Names({"a::b::A", "a::B", "C"}));
    EXPECT_EQ(names_in("template <std::array<int, 2> n> struct A<n> : Of<n> {};"), Names({"A<n>"}));
}

TEST(OneDefinition, IgnoresCodeThatDefinesNoType) {
    EXPECT_EQ(
        names_in("class A; enum class B : int; struct C made() { return {}; } struct D value{1};"
                 "template <class E> void f(E e) { struct F {}; } using namespace std; using std::array;"
                 "namespace fs = std::filesystem; int count = [] { struct G {}; return 1; }();"),
        Names());
    EXPECT_EQ(
        names_in("// struct A {};\n/* struct B {}; */ const char* c = \"struct C {};\"; char q = '\"';\n"
                 "#define D \\\n struct D {};\n"
                 "auto raw = R\"x(struct E {}; \")x\"; int f = 1'000; struct G {};"),
        Names({"G"}));
}

} // namespace
} // namespace frustumscreen::tests
