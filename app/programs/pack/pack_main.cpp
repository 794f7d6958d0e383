/// frustumscreen-pack: verifies, lists, explains, draws and signs packs, and makes the keys for signing.
#include "app/pack/pack_sections.h"
#include "app/programs/common/command_line.h"
#include "app/programs/common/guarded_main.h"
#include "app/programs/pack/keygen_command.h"
#include "app/programs/pack/pack_preview.h"
#include "app/programs/pack/pack_report.h"
#include "app/programs/pack/sign_command.h"
#include "app/programs/pack/verify_command.h"
#include "app/settings/settings.h"
#include "firmware_host/base/json.h"
#include "firmware_host/base/output_file.h"
#include "firmware_host/base/version.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>

namespace frustumscreen::programs {
namespace {

struct Request {
    VerifyRequest verify;
    SignRequest sign;
    std::string key_name; ///< keygen
    std::filesystem::path pack;
    std::string config;
    std::filesystem::path output;
    bool json = false;
    bool table = false; ///< preview: the table's picture
};

void print_json(const nlohmann::ordered_json& json) {
    fmt::print("{}\n", json.dump(2));
}

/// A prop of usual size, of the kind that the pack was baked for.
settings::PropSettings usual_prop(const pack::Pack& pack) {
    return pack.prop_kind == settings::name_of(settings::PropKind::Cube) ? settings::cube_settings()
                                                                         : settings::PropSettings{};
}

int list(const Request& request) {
    const Result<OpenedPack> opened = open_pack(request.pack);
    if (!opened) {
        return exit_status("frustumscreen-pack", tl::unexpected<Error>(opened.error()));
    }
    if (request.json) {
        print_json(list_json(*opened, usual_prop(*opened->pack)));
    } else {
        fmt::print("{}", list_text(*opened, usual_prop(*opened->pack)));
    }
    return 0;
}

int explain(const Request& request) {
    std::optional<settings::PropSettings> configured;
    if (!request.config.empty()) {
        const Result<settings::CheckedSettings> settings = settings::load_settings(request.config);
        if (!settings) {
            return exit_status("frustumscreen-pack", tl::unexpected<Error>(settings.error()));
        }
        configured = (*settings)->prop;
    }
    const Result<OpenedPack> opened = open_pack(request.pack);
    if (!opened) {
        return exit_status("frustumscreen-pack", tl::unexpected<Error>(opened.error()));
    }
    const settings::PropSettings prop = configured.value_or(usual_prop(*opened->pack));
    if (request.json) {
        print_json(explain_json(*opened, prop));
    } else {
        fmt::print("{}", explain_text(*opened, prop));
    }
    return 0;
}

Result<image::Image8> table_picture_of(const std::filesystem::path& file) {
    TRY(pack::PackCard card, pack::load_pack_card(file));
    if (card.table_picture.texels.empty()) {
        return bad_input("pack.no_table_picture",
                         file.string() + ": it has no picture for the table; bake it again");
    }
    return std::move(card.table_picture);
}

Result<void> write_preview(const Request& request) {
    TRY_VOID(check_output_is_no_input(request.output, {{request.pack}}));
    TRY_VOID(check_output_place(request.output));
    TRY(const image::Image8 picture,
        request.table ? table_picture_of(request.pack) : preview_of_pack(request.pack));
    return write_file(request.output, image::encode_png(picture));
}

int preview(const Request& request) {
    const Result<void> written = write_preview(request);
    return exit_status("frustumscreen-pack", written);
}

int sign(SignRequest request) {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    request.now_s = static_cast<std::uint64_t>(
        std::max<std::int64_t>(1, std::chrono::floor<std::chrono::seconds>(now).count()));
    return sign_files(request);
}

/// The largest number that a reader of JSON keeps exactly.
constexpr std::uint64_t max_serial = (std::uint64_t{1} << 53U) - 1;

void add_looking_commands(CommandLine& app, Request& request) {
    CommandLine to_verify =
        app.add_subcommand("verify", "checks packs completely; exit status 1 if one is damaged or refused");
    to_verify.add_option("PACK", request.verify.packs, "packs (*.fspack)").required();
    to_verify
        .add_option("--key", request.verify.keys,
                    "public key (NAME.pub) to accept; without one, signatures are not checked")
        .allow_extra_args(false);
    to_verify.add_flag("--json", request.verify.json, "print JSON");
    CommandLine to_list = app.add_subcommand(
        "list", "lists a pack's title, levels with their errors, and parts with their sizes");
    to_list.add_option("PACK", request.pack, "a pack (*.fspack)").required();
    CommandLine to_explain =
        app.add_subcommand("explain", "prints everything in a pack and its placement in the prop");
    to_explain.add_option("PACK", request.pack, "a pack (*.fspack)").required();
    to_explain.add_option("--config", request.config,
                          "settings, TOML, with the prop (default: the default prop)");
    CommandLine to_preview =
        app.add_subcommand("preview", "draws the artifact from four sides as one picture");
    to_preview.add_option("PACK", request.pack, "a pack (*.fspack)").required();
    to_preview.add_option("-o,--output", request.output, "PNG file to write").required();
    to_preview.add_flag("--table", request.table,
                        "draw the small, cut-out picture that lies on the table instead");
    for (CommandLine command : {to_list, to_explain}) {
        command.add_flag("--json", request.json, "print JSON");
    }
}

void add_signing_commands(CommandLine& app, Request& request) {
    CommandLine to_keygen = app.add_subcommand(
        "keygen", "makes a key pair in minisign's format; asks for a password on a terminal");
    to_keygen.add_option("-o,--output", request.key_name, "NAME: writes NAME.key and NAME.pub").required();
    CommandLine to_sign = app.add_subcommand(
        "sign", "signs packs, set files and a kiosk's settings (*.toml -> *.toml.minisig)");
    to_sign
        .add_option("FILE", request.sign.files, "packs (*.fspack), set files (*.toml), settings (kiosk.toml)")
        .required();
    to_sign.add_option("--key", request.sign.key, "the secret key (NAME.key)").required();
    to_sign
        .add_option(
            "--serial", request.sign.serial,
            "serial number; on the kiosk a higher one replaces a lower one (default: seconds since 1970)")
        .within(std::uint64_t{1}, max_serial);
    to_sign.add_flag("--json", request.sign.json, "print JSON");
}

int run(int argc, char** argv) {
    CommandLine app("Verifies, lists, previews and signs packs.", "frustumscreen-pack");
    app.set_version_flag("--version", name_and_version("frustumscreen-pack"));
    app.require_subcommand();
    Request request;
    add_looking_commands(app, request);
    add_signing_commands(app, request);
    if (const auto end = app.end_of_arguments(argc, argv)) {
        return *end;
    }
    return app.got_subcommand("verify")    ? verify_packs(request.verify)
           : app.got_subcommand("list")    ? list(request)
           : app.got_subcommand("explain") ? explain(request)
           : app.got_subcommand("preview") ? preview(request)
           : app.got_subcommand("sign")    ? sign(request.sign)
                                           : exit_status("frustumscreen-pack", make_keys(request.key_name));
}

} // namespace
} // namespace frustumscreen::programs

int main(int argc, char** argv) {
    return frustumscreen::programs::guarded_main("frustumscreen-pack", frustumscreen::programs::run, argc,
                                                 argv);
}
