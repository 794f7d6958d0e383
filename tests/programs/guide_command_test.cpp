// `frustumscreen guide` in stereo, compared with two runs of one eye: the heads of their pose files are the two eyes.

#include "firmware_host/base/json.h"
#include "tests/programs/program_folder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <sstream>
#include <vector>

namespace frustumscreen::programs {
namespace {

using Json = nlohmann::json;

class GuideCommand : public ProgramFolder {
protected:
    /// The lines for these settings and heads, one head for each place of the prop; the head looks along +Y.
    [[nodiscard]] std::vector<Json> lines(const std::string& settings,
                                          const std::vector<std::array<double, 3>>& heads) const {
        put("kiosk.toml", settings);
        std::string poses = "t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok\n";
        for (std::size_t k = 0; k < heads.size(); ++k) {
            const auto [x, y, z] = heads[k];
            const double place = static_cast<double>(k) / static_cast<double>(heads.size());
            const double yaw = 6.0 * place;
            poses += fmt::format("{},1,{},{},0,{},0,0,{},1\n", k * 1000, 0.5 * place - 0.25,
                                 0.1 * std::sin(9.0 * place), std::cos(0.5 * yaw), std::sin(0.5 * yaw));
            poses += fmt::format("{},2,{},{},{},1,0,0,0,1\n", k * 1000, x, y, z);
        }
        put("poses.csv", poses);
        EXPECT_EQ(run("frustumscreen guide --config kiosk.toml --poses poses.csv --json"), 0)
            << text("err.txt");
        std::vector<Json> lines;
        std::istringstream out(text("out.txt"));
        for (std::string line; std::getline(out, line);) {
            lines.push_back(Json::parse(line, nullptr, false));
        }
        return lines;
    }
};

std::set<std::string> set_of(const Json& names) {
    return names.get<std::set<std::string>>();
}

TEST_F(GuideCommand, CombinesBothEyesInStereo) {
    constexpr double half_m = 0.05; // wide, so that the eyes often differ
    std::vector<std::array<double, 3>> middle;
    for (int k = 0; k < 120; ++k) {
        middle.push_back({0.5 * std::sin(0.7 * k), -0.4 - 0.2 * std::cos(0.3 * k), 0.4});
    }
    std::vector<std::array<double, 3>> left = middle;
    std::vector<std::array<double, 3>> right = middle;
    for (std::size_t k = 0; k < middle.size(); ++k) {
        left[k][0] -= half_m;
        right[k][0] += half_m;
    }
    const std::vector<Json> both = lines("[eye]\nstereo = \"anaglyph\"\ninterocular_mm = 100\n", middle);
    const std::vector<Json> l = lines("", left);
    const std::vector<Json> r = lines("", right);
    ASSERT_EQ(both.size(), middle.size());
    ASSERT_EQ(l.size(), middle.size());
    ASSERT_EQ(r.size(), middle.size());
    int differ = 0;
    int valid = 0;
    for (std::size_t k = 0; k < middle.size(); ++k) {
        std::set<std::string> seen = set_of(l[k].at("seen"));
        seen.merge(set_of(r[k].at("seen")));
        EXPECT_EQ(set_of(both[k].at("seen")), seen) << k;
        EXPECT_EQ(set_of(both[k].at("lit")), set_of(l[k].at("lit"))) << k;
        EXPECT_EQ(both[k].at("valid").get<bool>(),
                  l[k].at("valid").get<bool>() && r[k].at("valid").get<bool>())
            << k;
        EXPECT_NEAR(both[k].at("unlit_px").get<double>(),
                    0.5 * (l[k].at("unlit_px").get<double>() + r[k].at("unlit_px").get<double>()), 1e-6)
            << k;
        EXPECT_EQ(both[k].at("advice").is_null(), both[k].at("valid").get<bool>()) << k;
        differ += set_of(l[k].at("seen")) != set_of(r[k].at("seen")) ? 1 : 0;
        valid += both[k].at("valid").get<bool>() ? 1 : 0;
    }
    EXPECT_GT(differ, 5);
    EXPECT_GT(valid, 5);
    EXPECT_LT(valid, 115);
}

} // namespace
} // namespace frustumscreen::programs
