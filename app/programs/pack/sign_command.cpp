#include "app/programs/pack/sign_command.h"

#include "app/kiosk_copy/copy_request.h"
#include "app/kiosk_copy/kiosk_copy.h"
#include "app/library/exhibit_file.h"
#include "app/library/report_request.h"
#include "app/library/stick_settings.h"
#include "app/pack/attribution.h"
#include "app/pack/container/limits.h"
#include "app/pack/container/zip_archive.h"
#include "app/pack/manifest.h"
#include "app/pack/pack_file.h"
#include "app/pack/pack_magic.h"
#include "app/pack/pack_reader.h"
#include "app/pack/pack_relief.h"
#include "app/pack/pack_states.h"
#include "app/pack/pack_texts.h"
#include "app/pack/pack_torches.h"
#include "app/pack/pack_world.h"
#include "app/pack/sign_pack.h"
#include "app/pack/signature/secret_key.h"
#include "app/programs/common/guarded_main.h"
#include "app/programs/pack/password_prompt.h"
#include "app/settings/settings.h"
#include "firmware_host/base/json.h"
#include "firmware_host/base/open_file.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <cstdio>

namespace frustumscreen::programs {

namespace {

constexpr std::uintmax_t max_key_bytes = 4096;

Result<pack::SecretKey> read_secret_key(const std::filesystem::path& file) {
    TRY(const Bytes bytes, read_file(file, max_key_bytes));
    TRY(const bool encrypted, at(file.string(), pack::needs_password(as_text(bytes))));
    std::optional<Password> password;
    if (encrypted) {
        TRY(Password typed, ask_password("Password of " + file.string()));
        password.emplace(std::move(typed));
    }
    return at(file.string(), pack::parse_secret_key(as_text(bytes), password ? std::optional(password->view())
                                                                             : std::nullopt));
}

/// `before`: the signature that is replaced; ignored if it cannot be parsed.
Result<std::uint64_t> serial_for(const SignRequest& request, const std::optional<std::string>& before) {
    if (request.serial) {
        return *request.serial;
    }
    if (before) {
        const Result<pack::SignatureClaim> claim = pack::read_signature_claim(*before);
        if (claim && claim->serial > request.now_s) {
            return bad_input("sign.serial",
                             "its signature has the serial {} already, and this computer's clock gives "
                             "{}; set the clock right, or name a higher one with --serial",
                             claim->serial, request.now_s);
        }
        if (claim && claim->serial == request.now_s) {
            return request.now_s + 1; // the replaced one was made within this second
        }
    }
    return request.now_s;
}

/// Tabs separate the fields of a trusted comment; `printable` removes control characters from the file's name.
std::string signature_of(const pack::SecretKey& key, std::span<const std::byte> bytes, std::uint64_t serial,
                         const std::filesystem::path& file) {
    return key.sign(bytes,
                    fmt::format("serial:{}\tfile:{}\thashed", serial, printable(file.filename().string())));
}

/// The bytes of a pack to sign, and its present signature.
struct Signable {
    Bytes manifest;
    std::optional<std::string> before;
    std::vector<std::string> missing; ///< facts that the pack should have, a sentence each
};
struct Signed {
    std::uint64_t serial = 0;
    std::vector<std::string> missing;
};

/// Refuses packs that the kiosk would refuse despite a signature.
Result<Signable> read_sound(OpenFile file) {
    TRY(auto zip, pack::ZipReader::open(std::move(file)));
    TRY(Bytes manifest, pack::read_manifest_bytes(zip));
    TRY(pack::PackReader reader, pack::PackReader::open(std::move(zip), manifest));
    TRY(std::optional<std::string> before, reader.signature());
    TRY(const pack::VerifiedPack pack, pack::read_pack(reader));
    TRY_VOID(pack::check_set_and_spoken(*pack));
    TRY_VOID(pack::check_reliefs(*pack));
    TRY_VOID(pack::check_torches(*pack));
    TRY_VOID(pack::check_world(*pack));
    TRY_VOID(without_value(pack::states_of(*pack)));
    TRY(const pack::ScanRights rights, pack::scan_rights(*pack));
    return Signable{std::move(manifest), std::move(before), pack::missing_in(*pack, rights)};
}

Result<Signed> sign_pack(const SignRequest& request, const pack::SecretKey& key, const std::string& file) {
    TRY(OpenFile checked, OpenFile::open(file, pack::max_pack_bytes));
    TRY(OpenFile copied, OpenFile::open(file, pack::max_pack_bytes));
    TRY(const Signable pack, at(file, read_sound(std::move(checked))));
    TRY(const std::uint64_t serial, at(file, serial_for(request, pack.before)));
    return pack::write_with_signature(std::move(copied), signature_of(key, pack.manifest, serial, file), file)
        .map([&] {
            return Signed{serial, pack.missing};
        });
}

/// Replaces the name on the stick, with which messages of the set file's parser begin, by the file's name.
Error named(const std::string& file, Error error) {
    if (error.message.starts_with(library::exhibit_file_name)) {
        error.message.replace(0, library::exhibit_file_name.size(), file);
    }
    return error;
}

/// Checks a kiosk's settings or copy and the request for a copy, known by the file name that the stick requires; any other
/// *.toml must be a set file.
Result<void> check_sound(std::string_view text, const std::string& file) {
    const std::filesystem::path name = std::filesystem::path(file).filename();
    if (name == library::settings_file_name) {
        return settings::parse_settings(text, file).map([](const settings::CheckedSettings&) {});
    }
    if (name == library::copy_request_name) {
        return without_value(kiosk_copy::parse_copy_request(text));
    }
    if (name == library::kiosk_copy_name) {
        return at(file, without_value(kiosk_copy::parse_kiosk_copy(as_bytes(text))));
    }
    const Result<library::ExhibitFile> sound = library::parse_exhibit_file(text);
    return sound ? Result<void>() : tl::unexpected<Error>(named(file, sound.error()));
}

bool is_copy(const std::string& file) {
    return std::filesystem::path(file).filename() == library::kiosk_copy_name;
}

Result<Signed> sign_text(const SignRequest& request, const pack::SecretKey& key, const std::string& file) {
    static_assert(library::max_stick_settings_bytes == library::max_exhibit_file_bytes);
    TRY(const Bytes text,
        read_file(file, is_copy(file) ? kiosk_copy::max_kiosk_copy_bytes : library::max_exhibit_file_bytes));
    TRY_VOID(check_sound(as_text(text), file));
    const std::string beside = file + ".minisig";
    const Result<Bytes> before = read_file(beside, pack::max_signature_bytes);
    TRY(const std::uint64_t serial,
        at(file, serial_for(request, before ? std::optional<std::string>(as_text(*before)) : std::nullopt)));
    return write_file(beside, as_bytes(signature_of(key, text, serial, file))).map([&] {
        return Signed{serial, {}};
    });
}

Result<Signed> sign_file(const SignRequest& request, const pack::SecretKey& key, const std::string& file) {
    return file.ends_with(".toml") || is_copy(file) ? sign_text(request, key, file)
                                                    : sign_pack(request, key, file);
}

} // namespace

int sign_files(const SignRequest& request) {
    const Result<pack::SecretKey> key = read_secret_key(request.key);
    if (!key) {
        return exit_status("frustumscreen-pack", tl::unexpected<Error>(key.error()));
    }
    const std::string id = pack::text_of_key_id(key->public_key().id);
    auto report = nlohmann::ordered_json::array();
    int status = 0;
    for (const std::string& file : request.files) {
        const Result<Signed> done = sign_file(request, *key, file);
        if (!done) {
            status = exit_status("frustumscreen-pack", tl::unexpected<Error>(done.error()));
            report.push_back({{"file", file},
                              {"signed", false},
                              {"id", done.error().id.view()},
                              {"reason", done.error().message}});
            continue;
        }
        report.push_back({{"file", file},
                          {"signed", true},
                          {"key_id", id},
                          {"serial", done->serial},
                          {"missing", done->missing}});
        if (!request.json) {
            fmt::print("{}: signed with the key {}, serial {}\n", file, id, done->serial);
            for (const std::string& sentence : done->missing) {
                fmt::print("{}: missing: {}\n", file, sentence);
            }
        }
    }
    if (request.json) {
        fmt::print("{}\n", report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
    }
    return status;
}

} // namespace frustumscreen::programs
