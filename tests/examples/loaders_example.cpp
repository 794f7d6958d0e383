// Any artifact file becomes a source mesh. An error names the line that cannot be read.
#include "assets_baked/bake/loaders/load_bytes.h"

#include <gtest/gtest.h>

namespace frustumscreen::example {
namespace {

TEST(RoomExample, Loaders) {
    // example
    const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
    const bake::SourceMesh mesh = bake::load_mesh_bytes(as_bytes(square), "square.obj").value();
    EXPECT_EQ(mesh.positions.size(), 4U);
    EXPECT_EQ(mesh.triangles.size(), 2U);

    const Error error = bake::load_mesh_bytes(as_bytes(square + "f 1 2 5\n"), "square.obj").error();
    EXPECT_NE(error.message.find("line 6: vertex 5 is out of range"), std::string::npos) << error.message;
    // end
}

} // namespace
} // namespace frustumscreen::example
