// `frustumscreen run` with a torch that sweeps over the artifact: what it lights is lit, nothing else changes, and without
// [torch] nothing of it is there.
#include "app/image/image.h"
#include "firmware_host/base/json.h"
#include "tests/folders.h"
#include "tests/programs/kiosk_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace frustumscreen::synthetic {
namespace {

constexpr const char* torch_table =
    "[torch]\nsource = \"tracker\"\nopening_deg = 14\nattenuation = \"none\"\n";
constexpr const char* dark_table = "[eye]\ntracked = false\n[render]\nhighlight_code = 120\n";

/// The difference of the artifact from another picture: its lit pixels, their mean column, and those that are darker.
struct Lit {
    int artifact = 0;
    int pixels = 0;
    double column = 0.0;
    int darker = 0;
};

class RunTorch : public KioskFolder {
protected:
    /// The prop stands; the torch is to the right of it, 0.4 m high, and aims at `left` for two seconds, then at `right`: places on
    /// the table's x axis. It is carried there, so that it is taken.
    void put_poses(double left, double right) const {
        std::string text = "t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok\n";
        for (int k = 0; k < 80; ++k) {
            const double share = std::clamp((k - 36) / 8.0, 0.0, 1.0);
            const double aim = left + share * (right - left);
            const glm::dvec3 at(0.10 - 0.0025 * std::min(k, 12), -0.12, 0.4);
            const glm::dvec3 z = glm::normalize(glm::dvec3(aim, 0.0, 0.05) - at);
            const glm::dvec3 x = glm::normalize(glm::cross(z, glm::dvec3(0.0, 0.0, 1.0)));
            const glm::dquat q = glm::normalize(glm::quat_cast(glm::dmat3(x, glm::cross(z, x), z)));
            text += fmt::format("{},1,0,0,0,1,0,0,0,1\n", 50'000 * k);
            text += fmt::format("{},3,{},{},{},{},{},{},{},1\n", 50'000 * k, at.x, at.y, at.z, q.w, q.x, q.y,
                                q.z);
        }
        put("poses.csv", text);
    }
    nlohmann::json run(const std::string& into) const {
        const int status =
            shell(fmt::format("rm -rf {0}; '{1}/frustumscreen' run --config kiosk.toml --headless --fast "
                              "--json --out {0} --stills 2 --seconds 3.9 >out.json 2>err.txt",
                              into, bin_dir()));
        EXPECT_EQ(status, 0) << text("err.txt");
        return nlohmann::json::parse(text("out.json"), nullptr, false);
    }
    [[nodiscard]] image::Image8 picture(const std::string& name) const {
        return image::decode_png8(read_file(folder / name).value()).value();
    }
    [[nodiscard]] Lit lit(const std::string& name) const {
        const image::Image8 with = picture("with/" + name), without = picture("without/" + name);
        Lit lit;
        for (int y = 0; y < with.height; ++y) {
            for (int x = 0; x < with.width; ++x) {
                const glm::ivec3 before(without.at(x, y));
                const int change =
                    with.at(x, y).x + with.at(x, y).y + with.at(x, y).z - before.x - before.y - before.z;
                const bool artifact =
                    before.x + before.y + before.z > 30; // a torch shows nothing where there is nothing
                lit.artifact += artifact ? 1 : 0;
                if (artifact && change > 20) {
                    ++lit.pixels;
                    lit.column += x;
                }
                lit.darker += artifact && change < -6 ? 1 : 0;
            }
        }
        lit.column /= std::max(1, lit.pixels);
        return lit;
    }
};

TEST_F(RunTorch, LightsOnlyTheSpotItPointsAtWhileSweeping) {
    put_poses(-0.06, 0.06);
    write_settings("replay", dark_table);
    EXPECT_TRUE(run("without").at("torch").is_null());
    write_settings("replay", std::string(dark_table) + torch_table);
    const nlohmann::json torch = run("with").at("torch");
    EXPECT_EQ(torch.at("by"), "tracker");
    EXPECT_EQ(torch.at("state"), "lit");
    EXPECT_EQ(torch.at("content"), "white");
    const Lit first = lit("frame_00000.png"), second = lit("frame_00001.png");
    EXPECT_GT(first.pixels, 40);
    EXPECT_GT(second.pixels, 40);
    EXPECT_EQ(first.darker, 0);
    EXPECT_EQ(second.darker, 0);
    // The light moves by 12 cm, which are 50 pixels to the right; the artifact fills a part of both places.
    EXPECT_GT(second.column - first.column, 10.0);
    EXPECT_LT(second.column - first.column, 50.0);
}

TEST_F(RunTorch, DimsTheArtifactWhileItIsHeld) {
    put_poses(-0.06, 0.06);
    write_settings("replay", dark_table);
    static_cast<void>(run("without"));
    write_settings("replay", std::string(dark_table) + torch_table + "house_light = 0.3\n");
    static_cast<void>(run("with"));
    const Lit second = lit("frame_00001.png");
    EXPECT_GT(second.darker, second.artifact / 2);
}

TEST_F(RunTorch, ShowsOnlyAFaintSpotWhenPointedPastTheObject) {
    put_poses(0.30, 0.34);
    write_settings("replay", dark_table);
    static_cast<void>(run("without"));
    write_settings("replay", std::string(dark_table) + torch_table);
    EXPECT_EQ(run("with").at("torch").at("state"), "past");
    const Lit second = lit("frame_00001.png");
    EXPECT_EQ(second.pixels, 0);
    EXPECT_EQ(second.darker, 0);
    const image::Image8 with = picture("with/frame_00001.png"), without = picture("without/frame_00001.png");
    int spot = 0, most = 0;
    for (std::size_t k = 0; k < with.texels.size(); ++k) {
        const int change = int(with.texels[k].x) - int(without.texels[k].x);
        spot += change > 0 ? 1 : 0;
        most = std::max(most, int(with.texels[k].x) * (change > 0 ? 1 : 0));
    }
    EXPECT_GT(spot, 100);
    EXPECT_LE(most, 49); // sRGB's code of 3 % of the light is 48
}

/// Programs, bytes of GPU memory, devices and threads: what OpenGL and the program themselves say they have.
TEST_F(RunTorch, LoadsNothingWithoutATorch) {
    const auto loaded = [&](const std::string& more) {
        write_settings("simulated", more);
        EXPECT_EQ(
            shell(fmt::format(
                "'{}/frustumscreen' plan --json --config kiosk.toml --pack rings.fspack >out.json 2>err.txt",
                bin_dir())),
            0)
            << text("err.txt");
        return nlohmann::json::parse(text("out.json"));
    };
    const auto lights = [](const nlohmann::json& plan) {
        int count = 0;
        for (const nlohmann::json& program : plan.at("in").at("programs")) {
            count += program.get<std::string>().find("torch") != std::string::npos ? 1 : 0;
        }
        return count;
    };
    const nlohmann::json none = loaded("");
    const nlohmann::json kept = loaded("[torch]\nopening_deg = 20\n");
    const nlohmann::json with = loaded("[torch]\nsource = \"tracker\"\n");
    EXPECT_EQ(none.at("in"), kept.at("in"));
    EXPECT_EQ(none.at("in").at("torch"), "none");
    EXPECT_EQ(lights(none), 0);
    EXPECT_NE(none.dump().find("No torch is followed"), std::string::npos);
    EXPECT_EQ(with.at("in").at("torch"), "tracker");
    EXPECT_GT(lights(with), 0);
    EXPECT_EQ(with.at("in").at("planned_programs"), with.at("in").at("programs"));
    EXPECT_GT(with.at("in").at("gpu_bytes"), none.at("in").at("gpu_bytes"));
}

} // namespace
} // namespace frustumscreen::synthetic
