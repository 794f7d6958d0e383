// The cases of `frustumscreen-bench stability`, each as a test, with floating-point exceptions trapped where
// a case allows none: a NaN ends the program where it is made.

#include "app/bench/stability/report.h"
#include "app/bench/stability/stability.h"
#include "tests/folders.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cctype>
#include <cfenv>
#include <fstream>
#include <map>
#include <ostream>
#include <string>

namespace frustumscreen::bench {

void PrintTo(const StabilityCase& which, std::ostream* out) { // GoogleTest finds it by this name
    *out << which.theme << ": " << which.name;
}

namespace {

class Traps {
public:
    explicit Traps(bool on) {
        if (on) {
            std::feclearexcept(FE_ALL_EXCEPT);
            ::feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
        }
    }
    ~Traps() {
        ::fedisableexcept(FE_ALL_EXCEPT);
        std::feclearexcept(FE_ALL_EXCEPT);
    }
    Traps(const Traps&) = delete;
    Traps& operator=(const Traps&) = delete;
};

/// The bounds that docs/stability.md gives reasons for, in two digits, by quantity: of a case, `theme: name`.
std::map<std::string, std::string> published_bounds(const std::string& which) {
    std::ifstream page(source_dir() + "/docs/stability.md");
    const std::string begin = "| " + which + " | ";
    std::map<std::string, std::string> bounds;
    for (std::string line; std::getline(page, line);) {
        if (line.starts_with(begin)) {
            const std::size_t quantity_end = line.find(" | ", begin.size());
            const std::size_t bound_begin = quantity_end + 3;
            bounds[line.substr(begin.size(), quantity_end - begin.size())] =
                line.substr(bound_begin, line.find(" | ", bound_begin) - bound_begin);
        }
    }
    return bounds;
}

class Stability : public ::testing::TestWithParam<StabilityCase> {};

TEST_P(Stability, HoldsItsBounds) {
    StabilityOptions options;
    options.recordings = shared_dir() + "/data/tracker";
    StabilityResult result;
    {
        const Traps traps(GetParam().arithmetic == FloatingPoint::Strict);
        result = measure(GetParam(), options);
    }
    const std::map<std::string, std::string> published =
        published_bounds(GetParam().theme + ": " + GetParam().name);
    EXPECT_FALSE(published.empty()) << "docs/stability.md has no row of this case";
    for (const StabilityRow& row : result.rows) {
        const auto bound = published.find(row.quantity);
        EXPECT_TRUE(bound == published.end() || bound->second == fmt::format("{:.2g}", row.bound))
            << row.quantity << ": " << row.bound << ", and docs/stability.md has another bound";
        EXPECT_TRUE(row.held()) << row.quantity << ": " << row.observed << ", allowed " << row.bound;
    }
    if (!result.left_out.empty()) {
        GTEST_SKIP() << result.left_out;
    }
    EXPECT_FALSE(result.rows.empty());
}

std::string name_of(const ::testing::TestParamInfo<StabilityCase>& info) {
    std::string name;
    for (const char c : info.param.theme + " " + info.param.name) {
        if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
            name += c;
        } else if (!name.ends_with('_')) {
            name += '_';
        }
    }
    return name;
}

INSTANTIATE_TEST_SUITE_P(Case, Stability, ::testing::ValuesIn(stability_cases()), name_of);

} // namespace
} // namespace frustumscreen::bench
