#include "app/programs/sheet/room_picture.h"
#include "app/programs/sheet/sheet_animation.h"
#include "app/programs/sheet/sheet_cameras.h"
#include "app/programs/sheet/sheet_frames.h"
#include "app/programs/sheet/sheet_picture.h"
#include "app/programs/sheet/sheet_table.h"
#include "tests/base/temporary_folder.h"

#include <gtest/gtest.h>
#include <unistd.h>
#include <webp/demux.h>

#include <filesystem>

namespace frustumscreen::programs {
namespace {

class Sheet : public WithTemporaryFolder {
protected:
    /// Writes four frames of the prop sliding to the right under a white picture.
    void SetUp() override {
        std::string poses = "t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok\n";
        for (int k = 0; k < 4; ++k) {
            poses += std::to_string(k * 100000) + ",1," + std::to_string(0.03 * k) + ",0,0,1,0,0,0,1\n";
            const image::Image8 picture(320, 200, glm::u8vec4(90, 80, 70, 255));
            ASSERT_TRUE(
                write_file(folder / ("frame_0000" + std::to_string(k) + ".png"), image::encode_png(picture)));
        }
        put("poses.csv", poses);
        ASSERT_TRUE(write_file(folder / "frames.csv",
                               as_bytes("frame,t_us,ms,technique,estimated_error_mm,drawn,artifact\n"
                                        "0,0,90,level1,0.05,1,\"Bowl, blue\"\n"
                                        "1,100000,4,level1,0.05,1,\"Bowl, blue\"\n"
                                        "2,200000,0.1,level1,0.05,0,\"Bowl, blue\"\n"
                                        "3,300000,6,level1,0.05,1,\"Bowl, blue\"\n")));
        settings.emplace(*settings::parse_settings("", "kiosk.toml"));
    }

    std::optional<settings::CheckedSettings> settings;
};

TEST_F(Sheet, FramesHaveTheirPosesAndArtifacts) {
    const Result<FrameFolder> read = read_frame_folder(folder, {}, "", {0.0, -0.5, 0.5});
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->frames.size(), 4U);
    EXPECT_EQ(read->frames[2].label, "Bowl, blue");
    EXPECT_NEAR(read->frames[2].tracked_state.table_from_prop.translation.x, 0.06, 1e-12);
    EXPECT_EQ(evenly(read->frames, 2).size(), 2U);
    EXPECT_EQ(evenly(read->frames, 9).size(), 4U);
}

TEST_F(Sheet, FramesThatLookAlikeAreShownOnce) {
    const auto frame = [](double x_m, double turn_deg, const char* label) {
        SheetFrame one;
        one.label = label;
        one.tracked_state.table_from_prop.translation.x = x_m;
        one.tracked_state.table_from_prop.rotation =
            glm::angleAxis(glm::radians(turn_deg), glm::dvec3(0.0, 0.0, 1.0));
        return one;
    };
    const std::vector<SheetFrame> kept =
        distinct({frame(0.0, 0.0, "Bowl"), frame(0.001, 1.0, "Bowl"), frame(0.0, 0.0, "Cup"),
                  frame(0.0, 20.0, "Bowl"), frame(0.1, 20.0, "Bowl"), frame(0.0, 359.0, "Bowl")});
    ASSERT_EQ(kept.size(), 4U);
    EXPECT_EQ(kept[0].tracked_state.table_from_prop.translation.x,
              0.001); // the middle one of successive similar frames
    EXPECT_EQ(kept[1].label, "Cup");
    EXPECT_EQ(kept[3].tracked_state.table_from_prop.translation.x, 0.1);
}

TEST_F(Sheet, EachNarratedTextOfARestingPropHasItsOwnRow) {
    std::string poses = "t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok\n";
    for (int k = 0; k < 4; ++k) {
        poses += std::to_string(k * 100000) + ",1,0,0,0,1,0,0,0,1\n";
    }
    put("poses.csv", poses);
    ASSERT_TRUE(write_file(folder / "frames.csv", as_bytes("t_us,ms,artifact,state,language,told\n"
                                                           "0,1,Bowl,view,en,\n"
                                                           "100000,1,Bowl,describe,en,description.0\n"
                                                           "200000,1,Bowl,describe,en,label.0\n"
                                                           "300000,1,Bowl,describe,de,label.0\n")));
    const Result<FrameFolder> read = read_frame_folder(folder, {}, "", {});
    ASSERT_TRUE(read) << read.error().message;
    const std::vector<SheetFrame> rows = distinct(read->frames);
    ASSERT_EQ(rows.size(), 4U);
    EXPECT_EQ(rows[0].label, "Bowl: view, en");
    EXPECT_EQ(rows[1].label, "Bowl: describe, description.0, en");
    EXPECT_EQ(rows[3].label, "Bowl: describe, label.0, de");
}

TEST_F(Sheet, RejectsAFolderWithoutPosesOrWithMalformedTimes) {
    put("frames.csv", "t_us,ms\n0,fast\n");
    const Result<FrameFolder> damaged = read_frame_folder(folder, {}, "", {});
    ASSERT_FALSE(damaged);
    EXPECT_NE(damaged.error().message.find("frames.csv:2"), std::string::npos);
    std::filesystem::remove(folder / "poses.csv");
    const Result<FrameFolder> without_poses = read_frame_folder(folder, {}, "", {});
    ASSERT_FALSE(without_poses);
    EXPECT_NE(without_poses.error().message.find("poses.csv"), std::string::npos);
    for (const Result<FrameFolder>* refused : {&damaged, &without_poses}) {
        EXPECT_EQ(refused->error().message.find('\n'), std::string::npos) << refused->error().message;
    }
}

TEST_F(Sheet, TableOmitsTheFirstFrameAndCountsUnchangedOnes) {
    const Result<FrameFolder> read = read_frame_folder(folder, {}, "", {});
    ASSERT_TRUE(read);
    const std::vector<TableLine> lines = table_lines(read->records);
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(lines[0].frames, 2U);
    EXPECT_EQ(lines[0].unchanged, 1U);
    EXPECT_DOUBLE_EQ(lines[0].median_ms, 4.0);
    EXPECT_DOUBLE_EQ(lines[0].p99_ms, 6.0);
    EXPECT_NE(markdown_table(lines).find("| Bowl, blue | level1 | 2 | 1 | 4.00 | 6.00 | 1.50 | 0.050 |"),
              std::string::npos);
    TableLine sly = lines[0];
    sly.artifact = "<script>";
    EXPECT_EQ(html_table({sly}, "t").find("<script>"), std::string::npos);
}

TEST_F(Sheet, TheContactSheetHoldsEveryFrame) {
    const Result<FrameFolder> read = read_frame_folder(folder, {}, "", (*settings)->eye.default_m);
    const Result<typography::Typesetter> typesetter = typography::Typesetter::open();
    ASSERT_TRUE(read && typesetter);
    std::size_t made = 0;
    const Result<image::Image8> sheet = contact_sheet(**settings, read->frames, {}, *typesetter,
                                                      [&](std::size_t done, std::size_t) { made = done; });
    ASSERT_TRUE(sheet) << sheet.error().message;
    EXPECT_EQ(made, 4U);
    EXPECT_GT(sheet->width, sheet->height);
}

TEST_F(Sheet, ShowsTheWholeTableOnRequest) {
    // A green mark in each corner of the projector's picture, where words and pictures for the choice are shown.
    image::Image8 picture(320, 200, glm::u8vec4(0, 0, 0, 255));
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            if ((x < 20 || x >= 300) && (y < 20 || y >= 180)) {
                picture.at(x, y) = {0, 255, 0, 255};
            }
        }
    }
    ASSERT_TRUE(write_file(folder / "frame_00000.png", image::encode_png(picture)));
    Result<FrameFolder> read = read_frame_folder(folder, {}, "", (*settings)->eye.default_m);
    const Result<typography::Typesetter> typesetter = typography::Typesetter::open();
    ASSERT_TRUE(read && typesetter);
    read->frames.resize(1);
    const auto green = [&](bool whole_table) {
        SheetOptions options;
        options.whole_table = whole_table;
        const Result<image::Image8> sheet =
            contact_sheet(**settings, read->frames, options, *typesetter, [](std::size_t, std::size_t) {});
        EXPECT_TRUE(sheet);
        return std::count_if(sheet->texels.begin(), sheet->texels.end(), [](const glm::u8vec4& colour) {
            return colour.g > 60 && colour.r < colour.g / 2 && colour.b < colour.g / 2;
        });
    };
    EXPECT_EQ(green(false), 0);
    // Four squares, each a sixteenth of the picture's width, in the projector's tile of 832 pixels, and as many in the
    // visitor's.
    EXPECT_GT(green(true), 1.5 * 4 * 52 * 52);
}

TEST_F(Sheet, ThePropFillsMostOfTheVisitorsPicture) {
    const Result<FrameFolder> read = read_frame_folder(folder, {}, "", (*settings)->eye.default_m);
    ASSERT_TRUE(read);
    for (const SheetFrame& frame : read->frames) {
        const simulation::VisitorScene scene = visitor_scene(**settings, frame.tracked_state, 320, 200);
        const simulation::VisitorCamera camera = framed_camera(scene, {544, 340});
        double top = 1e9;
        double bottom = -1e9;
        for (const glm::dvec3& corner : scene.prop.corners) {
            const glm::dvec3 seen =
                camera.table_from_camera.inverse().point(scene.table_from_prop.point(corner));
            const double row = camera.pinhole.fy * seen.y / seen.z + camera.pinhole.cy;
            top = std::min(top, row);
            bottom = std::max(bottom, row);
        }
        EXPECT_NEAR(bottom - top, 0.85 * 340, 0.5);
        EXPECT_NEAR(0.5 * (bottom + top), 170.0, 0.5);
    }
}

TEST_F(Sheet, TheRoomsPictureShowsProjectorAndTable) {
    const Result<FrameFolder> read = read_frame_folder(folder, {}, "", (*settings)->eye.default_m);
    const Result<typography::Typesetter> typesetter = typography::Typesetter::open();
    ASSERT_TRUE(read && typesetter);
    const simulation::VisitorScene scene = visitor_scene(**settings, read->frames[1].tracked_state, 320, 200);
    const simulation::VisitorCamera camera = room_camera(scene, {760, 880});
    const geometry::RigidTransform camera_from_table = camera.table_from_camera.inverse();
    for (const glm::dvec3 point :
         {glm::dvec3(-0.4, -0.25, 0.0), glm::dvec3(0.4, 0.25, 0.0), glm::dvec3(0.0, 0.0, 1.2)}) {
        const auto pixel = camera.pinhole.pixel(camera_from_table.point(point));
        ASSERT_TRUE(pixel);
        EXPECT_GT(pixel->x, 0.0);
        EXPECT_GT(pixel->y, 0.0);
        EXPECT_LT(pixel->x, 760.0);
        EXPECT_LT(pixel->y, 880.0);
    }
    // The artifact looks as the visitor sees it, because the camera is on the line from the prop through the eye.
    const glm::dvec3 prop = scene.table_from_prop.point(scene.prop.middle);
    const glm::dvec3 to_eye = glm::normalize(scene.eye_m - prop);
    EXPECT_NEAR(glm::dot(to_eye, glm::normalize(camera.table_from_camera.translation - prop)), 1.0, 1e-12);
    EXPECT_TRUE(room_picture(**settings, read->frames[1], *typesetter));
}

TEST_F(Sheet, APictureOfAnotherShapeThanTheProjectorsIsRefused) {
    ASSERT_TRUE(write_file(folder / "frame_00001.png", image::encode_png(image::Image8(200, 200))));
    const Result<FrameFolder> read = read_frame_folder(folder, {}, "", {});
    ASSERT_TRUE(read);
    const Result<image::Image8> picture = read_picture(read->frames[1], (*settings)->projector.pinhole);
    ASSERT_FALSE(picture);
    EXPECT_NE(picture.error().message.find("frame_00001.png"), std::string::npos);
}

TEST_F(Sheet, AnimationLoopsForeverForwardsAndBackwards) {
    const Result<FrameFolder> read = read_frame_folder(folder, {}, "", (*settings)->eye.default_m);
    ASSERT_TRUE(read);
    const Result<Bytes> webp =
        visitor_animation(**settings, read->frames, {160, 100, 80.0F}, [](auto, auto) {});
    ASSERT_TRUE(webp) << webp.error().message;
    const WebPData data{reinterpret_cast<const std::uint8_t*>(webp->data()), webp->size()};
    WebPAnimDecoder* decoder = WebPAnimDecoderNew(&data, nullptr);
    ASSERT_NE(decoder, nullptr);
    WebPAnimInfo info;
    ASSERT_TRUE(WebPAnimDecoderGetInfo(decoder, &info));
    EXPECT_EQ(info.loop_count, 0U);
    EXPECT_EQ(info.frame_count, 6U); // 0 1 2 3 2 1
    std::uint8_t* pixels = nullptr;
    int end_ms = 0;
    int frames = 0;
    while (WebPAnimDecoderHasMoreFrames(decoder) != 0) {
        ASSERT_TRUE(WebPAnimDecoderGetNext(decoder, &pixels, &end_ms));
        ++frames;
    }
    EXPECT_EQ(frames, 6);
    EXPECT_GE(end_ms, 500);
    WebPAnimDecoderDelete(decoder);
}

TEST_F(Sheet, ClosedAnimationPlaysForwardsAndIsLossless) {
    const Result<FrameFolder> read = read_frame_folder(folder, {}, "", (*settings)->eye.default_m);
    ASSERT_TRUE(read);
    const Result<Bytes> webp =
        visitor_animation(**settings, read->frames, {160, 100, 80.0F, true, true}, [](auto, auto) {});
    ASSERT_TRUE(webp) << webp.error().message;
    const WebPData data{reinterpret_cast<const std::uint8_t*>(webp->data()), webp->size()};
    WebPDemuxer* demuxer = WebPDemux(&data);
    ASSERT_NE(demuxer, nullptr);
    EXPECT_EQ(WebPDemuxGetI(demuxer, WEBP_FF_FRAME_COUNT), 4U);
    WebPIterator frame;
    int all_ms = 0;
    for (int more = WebPDemuxGetFrame(demuxer, 1, &frame); more != 0; more = WebPDemuxNextFrame(&frame)) {
        WebPBitstreamFeatures features;
        ASSERT_EQ(WebPGetFeatures(frame.fragment.bytes, frame.fragment.size, &features), VP8_STATUS_OK);
        EXPECT_EQ(features.format, 2); // lossless
        all_ms += frame.duration;
    }
    EXPECT_EQ(all_ms, 400);
    WebPDemuxReleaseIterator(&frame);
    WebPDemuxDelete(demuxer);
}

} // namespace
} // namespace frustumscreen::programs
