// A curator's folder whose artifact a test changes, and what frustumscreen-bake says of it.
#pragma once

#include "app/image/image.h"
#include "firmware_host/base/file.h"
#include "tests/programs/program_folder.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <string>

namespace frustumscreen::programs {

class CuratorsFolder : public ProgramFolder {
protected:
    /// A picture of one colour at `path` of the test's folder.
    void put_picture(const std::string& path, const glm::ivec2& size, const glm::u8vec4& colour) const {
        ASSERT_TRUE(write_file(folder / path, image::encode_png(image::Image8(size.x, size.y, colour))));
    }
    /// The sentence of the check of a folder that cannot be baked.
    [[nodiscard]] std::string refusal_of(const std::string& name) const {
        EXPECT_EQ(run("frustumscreen-bake --check " + name), 1) << text("out.txt");
        const std::string told = text("err.txt");
        EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 1) << told;
        return told;
    }
};

} // namespace frustumscreen::programs
