#include "app/programs/calibrate/calibrate_request.h"

#include "app/settings/settings.h"

#include <fmt/format.h>

namespace frustumscreen {

void add_common_options(CLI::App& command, CalibrateRequest& request) {
    command.add_option("--from", request.from, "the points, CSV")->required();
    CLI::Option* const picture =
        command
            .add_option("--picture", request.picture, "width and height of the projector's picture, pixels")
            ->expected(2)
            ->check(CLI::Range(16, 16384));
    command.add_option("--config", request.config, "or the kiosk's settings, TOML, which have it")
        ->excludes(picture);
    command.add_flag("--json", request.json, "for programs");
}

void check_request(const CalibrateRequest& request) {
    if (!request.from.empty() && request.picture.empty() && request.config.empty()) {
        throw CLI::RequiredError("--picture W H, or --config FILE,");
    }
}

Result<PictureSize> picture_size(const CalibrateRequest& request) {
    if (!request.picture.empty()) {
        return PictureSize{request.picture[0], request.picture[1]};
    }
    const Result<CheckedSettings> settings = load_settings(request.config);
    if (!settings) {
        return tl::unexpected<Error>(settings.error());
    }
    const Pinhole& pinhole = (*settings)->projector.pinhole;
    return PictureSize{pinhole.width, pinhole.height, (*settings)->prop.height_m};
}

nlohmann::ordered_json matrix_json(const RigidTransform& transform) {
    const glm::dmat4 matrix = transform.matrix();
    nlohmann::ordered_json numbers = nlohmann::ordered_json::array();
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            numbers.push_back(matrix[column][row]);
        }
    }
    return numbers;
}

int status_of(Verdict verdict, const CalibrateRequest& request, const std::string& reason) {
    if (verdict == Verdict::Good || verdict == Verdict::Usable) {
        return 0;
    }
    fmt::print(stderr, "frustumscreen-calibrate: {}: {}: {}\n", request.from.string(), name_of(verdict),
               reason);
    return 1;
}

} // namespace frustumscreen
