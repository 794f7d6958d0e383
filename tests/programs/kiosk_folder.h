// A folder with a kiosk's settings, a small pack and a pose file, for tests of the program.
#pragma once

#include "app/pack/pack_file.h"
#include "tests/programs/program_folder.h"
#include "tests/render/synthetic_pack.h"

#include <gtest/gtest.h>

#include <string>

namespace frustumscreen::synthetic {

class KioskFolder : public programs::ProgramFolder {
protected:
    void SetUp() override {
        pack::Pack pack = rings();
        pack.title = "Rings";
        pack.languages = {"en"};
        pack.captions = {{"en", "Rings", ""}};
        pack.provenance.source_name = "rings.glb";
        pack.provenance.source_sha256 = std::string(64, 'a');
        pack.relief_size = 512;
        pack.levels[0].error = {1e-3F, 2e-3F, 3e-3F, 0.0F};
        for (unsigned k = 0; k < 8; ++k) {
            pack.extremes.emplace_back(((k & 1U) != 0 ? 0.5 : -0.5) * pack.box_size.x,
                                       ((k & 2U) != 0 ? 0.5 : -0.5) * pack.box_size.y,
                                       (k & 4U) != 0 ? pack.box_size.z : 0.0);
        }
        const Result<Bytes> bytes = pack::write_pack(pack);
        ASSERT_TRUE(bytes) << bytes.error().message;
        ASSERT_TRUE(write_file(folder / "rings.fspack", *bytes));
        put("poses.csv", "t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok\n"
                         "0,1,0.02,0,0,1,0,0,0,1\n");
        write_settings("replay", "");
    }
    void write_settings(const std::string& tracker, const std::string& more) const {
        put("kiosk.toml", "[projector]\nwidth = 320\nheight = 200\nrefresh_hz = 20.0\n[tracker]\nkind = \"" +
                              tracker + "\"\nposes = \"poses.csv\"\n[exhibit]\npacks = [\"rings.fspack\"]\n" +
                              more);
    }
};

} // namespace frustumscreen::synthetic
