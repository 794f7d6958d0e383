// Writes small inputs for every fuzz target: FOLDER/TARGET/NAME. The corpora grew from these by fuzzing.
#include "app/pack/block_part.h"
#include "app/pack/container/zip_archive.h"
#include "app/pack/glyph_runs.h"
#include "app/pack/manifest.h"
#include "app/pack/world_sections.h"
#include "assets_baked/artifacts/builtin.h"
#include "assets_baked/folder/new_folder.h"
#include "firmware_host/tracker/packet_file.h"
#include "tests/folders.h"
#include "tests/fuzz/words_file.h"
#include "tests/loaders/sample_models.h"
#include "tests/loaders/sample_pictures.h"
#include "tests/pack/world_samples.h"
#include "tests/signature/vectors.h"
#include "tests/texts/wav_bytes.h"
#include "tests/tracker/wire_bytes.h"

#include <sndfile.h>

#include <cmath>
#include <cstdio>
#include <fstream>

using namespace frustumscreen;
using namespace frustumscreen::artifacts;
using namespace frustumscreen::folder;
using namespace frustumscreen::image;
using namespace frustumscreen::pack;
using namespace frustumscreen::tracker;

namespace {

class Seeds {
public:
    explicit Seeds(std::filesystem::path folder) : folder_(std::move(folder)) {}

    void add(const std::string& target, const std::string& name, std::string_view bytes) const {
        std::filesystem::create_directories(folder_ / target);
        std::ofstream(folder_ / target / name, std::ios::binary) << bytes;
    }

private:
    std::filesystem::path folder_;
};

std::string file_text(const std::string& path) {
    std::ifstream file(std::filesystem::path(source_dir()) / path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void texts(const Seeds& seeds) {
    seeds.add(
        "pose_file", "plain",
        "t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok\n# two rows\n0,1,0.1,-0.05,0,1,0,0,0,1\n"
        "16667,1,1e-3,0.25,0,0.5,0.5,-0.5,0.5,1\n16667,2,0,-0.55,0.5,1,0,0,0,1\n33334,3,nan,0,0,0,0,0,0,0\n");
    seeds.add("recording", "blanks",
              "# timestamp tx ty tz qx qy qz qw\n1.5 0.1 0.2 0.3 0 0 0 1\n1.6 0.4 0 1 0 0 1 0\n");
    seeds.add("recording", "commas",
              "t,x,y,z,qx,qy,qz,qw\n-1e3,1,2,3,0.5,0.5,0.5,0.5\n4,5,6,7,-0.5,-0.5,-0.5,-0.5\n");
    seeds.add("point_files", "touches",
              "tx_m,ty_m,tz_m,qw,qx,qy,qz,u_px,v_px,block_m\n0.1,-0.2,0.3,1,0,0,0,640,400,0.12\n");
    seeds.add("point_files", "rests",
              "rest,tx_m,ty_m,tz_m,qw,qx,qy,qz,x_m,y_m,z_m,u_px,v_px,block_m\n"
              "1,0.1,-0.2,0.3,0.5,0.5,-0.5,0.5,0.05,0.05,0,640.5,400,0.003\n"
              "2,0.1,-0.2,0.3,0.5,0.5,-0.5,0.5,0.05,0.05,0,640.5,400,\n");
    seeds.add("point_files", "sights",
              "eye,tx_m,ty_m,tz_m,qw,qx,qy,qz,u_px,v_px,x_m,y_m,z_m\nleft,0,-0.8,0.5,1,0,0,0,700,300,0.04,0."
              "04,0.12\n"
              "right,0,-0.8,0.5,0.5,0.5,0.5,0.5,700,300,0.04,0.04,0.12\n");
    seeds.add("point_files", "corners",
              "distance,corner,x_m,y_m,z_m\n1,top_left,-0.5,0.3,0\n2,bottom_right,0.5,-0.3,0.4\n");
    seeds.add("settings", "shipped", file_text("config/kiosk.toml"));
    seeds.add("settings", "gpio",
              "[panel]\nkind = \"gpio\"\nlines = [\"4\", \"5\", \"6\"]\nbias = \"pull-down\"\n");
    seeds.add("settings", "matrices",
              "[projector]\nfx = 1900\nfy = 1910\ncx = 640\ncy = -20\n"
              "table_from_projector = [1,0,0,0, 0,-1,0,0, 0,0,-1,0, 0,0,1.2,1]\n[prop]\nkind = "
              "\"cube\"\nbase_m = 0.1\n");
    seeds.add(
        "words", "small",
        "name = \"X\"\nhelp = \"\303\234bung\"\n[advice]\nset_down = \"a\"\n[fault]\nno_artifact = \"b\"\n");
    seeds.add("words", "misspelt", "nam = 3\nadvice.set_down = \"\\u202e\"\n");
    seeds.add("settings", "replay",
              "tracker = { kind = \"replay\", poses = \"p.csv\", table_from_tracker = "
              "[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1] }\n");
}

/// Scripts of viper_fuzz.cpp and patriot_fuzz.cpp: the set-up succeeds, then frames arrive.
void talks(const Seeds& seeds) {
    const std::string agree(14, '\3');
    const std::string wait("\0\x19\0", 3);
    const std::string pose("\4\1\0\0\0\1\0\2\0\3\x7f\0\0\0", 14);
    seeds.add("viper", "streaming", agree + pose + wait + pose + wait + pose);
    seeds.add("viper", "cut", agree + "\6\1" + pose + wait + pose);
    std::string patriot;
    for (int k = 0; k < 24; ++k) {
        patriot += wait + "\3";
    }
    seeds.add("patriot", "streaming", patriot + pose + wait + pose + wait + pose);
    seeds.add("patriot", "cut", patriot + "\6\1" + pose + wait + pose);
    std::string hid("\3\2");
    for (int k = 0; k < 4; ++k) {
        hid += wait.substr(0, 1) + std::string("\10\0", 2) + pose + std::string(1, '\0');
    }
    seeds.add("hid_tracker", "streaming", hid);
    const std::string push("\x20\0\7\1\x5e\1\0\0\x80\0", 10);
    const std::string both("\x20\0\15\1\x5e\1\0\0\x80\0\x20\3\0\0\1\1", 16);
    seeds.add("space_mouse", "push", push + push + both + push);
}

/// One device of each make, opened and streaming.
void recordings(const Seeds& seeds) {
    for (const UsbTrackerModel model : {UsbTrackerModel::Viper, UsbTrackerModel::Patriot,
                                        UsbTrackerModel::Hid, UsbTrackerModel::SpaceMouse}) {
        Bytes file;
        append_packet_header(file);
        std::int64_t time_us = 1'000'000;
        const auto add = [&](PacketKind kind, std::span<const std::byte> payload) {
            append_packet(file, {kind, from_microseconds(time_us += 8333), payload});
        };
        add(PacketKind::About, as_bytes("a seed"));
        add(PacketKind::Opened, OpenedDevice{model, {}}.bytes());
        add(PacketKind::Sent, as_bytes("P"));
        add(PacketKind::Received, wire::viper_frame(1, {{}}));
        add(PacketKind::Received, wire::patriot_frame(1, 1, {}));
        add(PacketKind::Received, as_bytes(std::string_view("\1\x20\1\0\0\0\0", 7)));
        add(PacketKind::State, as_bytes("the tracker is running"));
        add(PacketKind::Dropped, as_bytes(std::string_view("\3\0\0\0\0\0\0\0", 8)));
        add(PacketKind::Closed, {});
        seeds.add("packets", std::to_string(static_cast<int>(model)), as_text(file));
    }
}

void packs(const Seeds& seeds) {
    const Bytes pack = samples::bytes_of(samples::pack());
    seeds.add("pack", "everything", as_text(pack));
    Pack mesh_only = samples::pack();
    mesh_only.levels.pop_back();
    mesh_only.textures.pop_back();
    mesh_only.relief = {};
    mesh_only.default_level = 0;
    seeds.add("pack", "mesh", as_text(samples::bytes_of(mesh_only)));
    mesh_only.textures[0] = Image8(40, 30, {10, 20, 30, 255}); // as WebP
    seeds.add("pack", "webp", as_text(samples::bytes_of(mesh_only)));
    seeds.add("manifest", "everything", samples::take_apart(pack).manifest.dump());
    const Bytes full = samples::bytes_of(samples::full_pack());
    seeds.add("pack", "sections", as_text(full));
    seeds.add("pack", "words", as_text(samples::bytes_of(samples::pack_with_words())));
    seeds.add("manifest", "sections", samples::take_apart(full).manifest.dump());
}

void worlds(const Seeds& seeds) {
    const Pack pack = samples::pack_with_world();
    const std::string curves(as_text(pack.section_parts.at("behaviours/curves.bin")));
    seeds.add("curves", "every_kind", curves);
    seeds.add("curves", "cut", curves.substr(0, 60));
    const std::string cells = write_cells(samples::cells());
    seeds.add("world", "every_kind", cells + "\n" + write_behaviours(samples::behaviours()));
    seeds.add("world", "cells", cells + "\n{\"behaviours\":[]}");
    seeds.add("world", "cycle", R"({"cells":[{"name":"a","parent":0}]})");
    // A pack within 8 kB, as the fuzzer's inputs are.
    Pack small = samples::small_cell_pack();
    PackWorld world{{samples::cells().front()}, {samples::behaviours().back()}};
    if (put_world(small, world, std::vector{samples::small_cell_pack()})) {
        seeds.add("pack", "world", as_text(samples::bytes_of(small)));
    }
}

void signatures(const Seeds& seeds) {
    seeds.add("signature", "hash", vectors::of_the_hash);
    seeds.add("signature", "bytes", vectors::of_the_bytes);
    seeds.add("keys", "public", vectors::open_public);
    seeds.add("keys", "line", vectors::encrypted_public);
    seeds.add("keys", "open", vectors::open_key);
    seeds.add("keys", "encrypted", vectors::encrypted_key);
}

void folders(const Seeds& seeds) {
    for (const std::string_view name : builtin_names()) {
        seeds.add("artifact_file", std::string(name), builtin_folder_text(name));
    }
    const ScanFacts scan{"vase.stl", {}, {-1, 0, 2}, {1, 5, 4}, 'z'};
    seeds.add("artifact_file", "new", new_artifact_text(scan, "A vase", "vase-1"));
    seeds.add("artifact_file", "few",
              "scan = 'a.stl'\nplacement = { up = '-z', turn_deg = -3e1, scale = 1.5, lift = 0 }\n"
              "texts = [{ language = 'el', text = \"\"\"\na.\n\\u00e4\"\"\" }]\n"
              "hotspots = [{ point = [1, 2.5, -3e2], labels = { en = 'x', 'pt-BR' = 'y' } }]\n");
}

void glyph_runs(const Seeds& seeds) {
    GlyphRuns runs{40, 4, 32, 36, {{0, 0, 30, 36, -3, 33}, {30, 0, 0, 0, 0, 0}}, {}};
    runs.texts = {
        {"name", TextDirection::RightToLeft, {{9216, 1290, 1395, {{1095, 2}}, {{0, 0, 260}, {1, -16, 0}}}}}};
    seeds.add("glyph_runs", "example", as_text(encode_glyph_runs(runs)));
    // Two texts, one of them set for two widths: a paragraph's empty line, a repeated glyph.
    runs.texts[0].settings.push_back(
        {4096, 1290, 4200, {{1095, 1}, {2400, 0}, {3795, 1}}, {{0, 0, 0}, {0, 7, 0}}});
    runs.texts.push_back({"title", TextDirection::LeftToRight, {{2048, 0, 1395, {{1095, 1}}, {{1, 0, 0}}}}});
    seeds.add("glyph_runs", "widths", as_text(encode_glyph_runs(runs)));
    seeds.add("glyph_runs", "spaces",
              as_text(encode_glyph_runs(
                  {12,
                   2,
                   0,
                   0,
                   {{0, 0, 0, 0, 0, 0}},
                   {{"text", TextDirection::LeftToRight, {{512, 0, 1400, {{1100, 1}}, {{0, 0, 0}}}}}}})));
    seeds.add("glyph_runs", "none", as_text(encode_glyph_runs({12, 2, 0, 0, {}, {}})));
}

void relief_blocks(const Seeds& seeds) {
    const Bytes small = pack::encode_blocks(samples::block_relief(32));
    seeds.add("relief_blocks", "hill", as_text(small));
    seeds.add("relief_blocks", "cut", as_text(small).substr(0, 500));
    Bytes not_finite = small;
    std::fill(not_finite.begin() + 100, not_finite.begin() + 116, std::byte{0xff});
    seeds.add("relief_blocks", "not_finite", as_text(not_finite));
}

void words_files(const Seeds& seeds) {
    const Bytes file = fuzz::small_words_file();
    seeds.add("words_file", "two", as_text(file));
    Result<pack::ZipReader> zip = pack::ZipReader::open(file);
    const Result<Bytes> manifest = zip->read(*zip->find("manifest.json"));
    seeds.add("words_file", "manifest", as_text(*manifest)); // its second language lacks its parts
    nlohmann::json one = nlohmann::json::parse(as_text(*manifest));
    one["languages"].erase(1);
    seeds.add("words_file", "one", one.dump());
    one["languages"][0]["sounds"] = nlohmann::json::array();
    seeds.add("words_file", "silent", one.dump());
}

void pictures(const Seeds& seeds) {
    const Image8 smooth = frustumscreen::testing::smooth_picture(8, 8);
    seeds.add("picture", "smooth.png", frustumscreen::testing::png_of(smooth));
    seeds.add("picture", "smooth.jpg", frustumscreen::testing::jpeg_of(smooth));
    seeds.add("picture", "smooth.webp", frustumscreen::testing::webp_of(smooth));
    seeds.add("picture", "smooth.bmp", frustumscreen::testing::bmp_of(smooth));
    seeds.add("picture", "smooth.tga", frustumscreen::testing::tga_of(smooth));
    seeds.add("picture", "runs.tga", frustumscreen::testing::tga_of(Image8(8, 8, {1, 2, 3, 255}), true));
    seeds.add("picture", "smooth.tiff", frustumscreen::testing::tiff_of(smooth));
    seeds.add("picture", "alpha.tiff",
              frustumscreen::testing::tiff_of(smooth, frustumscreen::testing::TiffAlpha::Apart, true));
    seeds.add("picture", "lossless.webp", as_text(encode_webp(smooth)));
    seeds.add("picture", "cut.png", frustumscreen::testing::png_of(samples::texture(5, 3, 1, false)));
    seeds.add("picture", "relief.png", as_text(encode_png(samples::relief_atlas().relief)));
    for (const int depth : {1, 2, 4, 8, 16}) {
        seeds.add("picture", "grey" + std::to_string(depth),
                  frustumscreen::testing::grey_ramp_png(depth, depth == 8));
    }
}

/// A tenth of a second, written by libsndfile.
std::string written_sound(int format, int channels) {
    const std::filesystem::path file = std::filesystem::temp_directory_path() / "frustumscreen_seed_sound";
    SF_INFO info{};
    info.samplerate = 8000;
    info.channels = channels;
    info.format = format;
    if (SNDFILE* const sound = sf_open(file.c_str(), SFM_WRITE, &info)) {
        std::vector<float> samples(static_cast<std::size_t>(800 * channels));
        for (std::size_t k = 0; k < samples.size(); ++k) {
            samples[k] = 0.3F * std::sin(0.4F * static_cast<float>(k));
        }
        sf_writef_float(sound, samples.data(), 800);
        sf_close(sound);
    }
    std::ifstream stream(file, std::ios::binary);
    std::string bytes(std::istreambuf_iterator<char>(stream), {});
    std::filesystem::remove(file);
    return bytes;
}

/// Recordings of a few packets, written by libsndfile.
void sounds(const Seeds& seeds) {
    const std::string mono = file_text("tests/fuzz/corpus/opus/mono");
    const std::string stereo = file_text("tests/fuzz/corpus/opus/stereo");
    seeds.add("opus", "mono", mono);
    seeds.add("opus", "stereo", stereo);
    seeds.add("opus", "chain", mono + stereo);
    seeds.add("speech", "mono.opus", mono);
    seeds.add("speech", "stereo.opus", stereo);
    using frustumscreen::testing::sine;
    seeds.add("speech", "16.wav",
              as_text(frustumscreen::testing::wav16(sine(0.5, 0.01, 997.0, 8000.0), 8000)));
    seeds.add("speech", "lies.wav",
              as_text(frustumscreen::testing::wav({1, 2, 44100, 16, 0xffffff00U}, Bytes(64, std::byte{3}))));
    seeds.add("speech", "float.wav",
              as_text(frustumscreen::testing::wav({3, 1, 48000, 32}, Bytes(64, std::byte{0x3e}))));
    seeds.add("speech", "ima.wav", written_sound(SF_FORMAT_WAV | SF_FORMAT_IMA_ADPCM, 1));
    seeds.add("speech", "mono.flac", written_sound(SF_FORMAT_FLAC | SF_FORMAT_PCM_16, 1));
    seeds.add("speech", "stereo.flac", written_sound(SF_FORMAT_FLAC | SF_FORMAT_PCM_24, 2));
    seeds.add("speech", "mono.ogg", written_sound(SF_FORMAT_OGG | SF_FORMAT_VORBIS, 1));
}

void meshes(const Seeds& seeds) {
    seeds.add("mesh", "meshlab.ply", file_text("tests/fuzz/corpus/mesh/meshlab.ply"));
    for (const frustumscreen::testing::SampleModel& model : frustumscreen::testing::sample_models()) {
        const bool gltf = model.name.ends_with(".glb") || model.name.ends_with(".gltf");
        seeds.add(gltf ? "gltf" : "mesh", model.name, model.bytes);
    }
    int number = 0;
    for (const std::string name :
         {"a.png", "b/../a.png", "../a.png", "/etc/a", "C:\\a", "b%20c", "%2e%2e/a", "http://a"}) {
        seeds.add("sidecar", "name" + std::to_string(++number), name);
    }
}

} // namespace

int main(int count, char** arguments) {
    if (count != 2) {
        std::fputs("usage: frustumscreen_fuzz_seeds FOLDER\n", stderr);
        return 2;
    }
    const Seeds seeds(arguments[1]);
    texts(seeds);
    talks(seeds);
    recordings(seeds);
    packs(seeds);
    worlds(seeds);
    signatures(seeds);
    folders(seeds);
    glyph_runs(seeds);
    relief_blocks(seeds);
    words_files(seeds);
    pictures(seeds);
    meshes(seeds);
    sounds(seeds);
    return 0;
}
