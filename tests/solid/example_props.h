/// The props of config/prop_*.obj, for tests.
///
/// Errors   a file that is missing or refused ends the test's program.
#pragma once

#include "app/solid/prop_file.h"
#include "app/solid/shape_of.h"
#include "firmware_host/base/file.h"
#include "tests/folders.h"

#include <filesystem>
#include <string>

namespace frustumscreen::solid {

/// `name`: of the file, without "prop_" and its ending.
inline geometry::PropShape example_prop(const std::string& name, Underside underside = Underside::Lit) {
    const Result<Bytes> bytes =
        read_file(std::filesystem::path(source_dir()) / "config" / ("prop_" + name + ".obj"));
    return shape_of(parse_prop_file(as_text(bytes.value()), LengthUnit::Millimetre).value().solid, underside);
}

} // namespace frustumscreen::solid
