#include "app/programs/pack/sign_command.h"

#include "app/library/exhibit_file.h"
#include "app/pack/limits.h"
#include "app/pack/manifest.h"
#include "app/pack/pack_file.h"
#include "app/pack/pack_magic.h"
#include "app/pack/pack_reader.h"
#include "app/pack/pack_texts.h"
#include "app/pack/secret_key.h"
#include "app/pack/sign_pack.h"
#include "app/programs/common/guarded_main.h"
#include "app/programs/pack/password_prompt.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdio>

namespace frustumscreen {

namespace {

constexpr std::uintmax_t most_key_bytes = 4096;

Result<SecretKey> read_secret_key(const std::filesystem::path& file) {
    const Result<Bytes> bytes = read_file(file, most_key_bytes);
    if (!bytes) {
        return tl::unexpected<Error>(bytes.error());
    }
    const Result<bool> encrypted = needs_password(as_text(*bytes));
    if (!encrypted) {
        return at(file.string(), encrypted.error());
    }
    std::optional<Password> password;
    if (*encrypted) {
        Result<Password> typed = ask_password("Password of " + file.string());
        if (!typed) {
            return tl::unexpected<Error>(typed.error());
        }
        password.emplace(*std::move(typed));
    }
    Result<SecretKey> key =
        parse_secret_key(as_text(*bytes), password ? std::optional(password->view()) : std::nullopt);
    if (!key) {
        return at(file.string(), key.error());
    }
    return key;
}

/// `before`: the signature that is replaced. One that is no signature says nothing.
Result<std::uint64_t> serial_for(const SignRequest& request, const std::optional<std::string>& before) {
    if (request.serial) {
        return *request.serial;
    }
    if (before) {
        const Result<SignatureClaim> claim = read_signature_claim(*before);
        if (claim && claim->serial > request.now_s) {
            return bad_input(
                fmt::format("its signature has the serial {} already, and this computer's clock gives "
                            "{}; set the clock right, or name a higher one with --serial",
                            claim->serial, request.now_s));
        }
        if (claim && claim->serial == request.now_s) {
            return request.now_s + 1; // it was signed within this second
        }
    }
    return request.now_s;
}

/// Tabs part the fields of a trusted comment, and no control character gets into it.
std::string signature_of(const SecretKey& key, std::span<const std::byte> bytes, std::uint64_t serial,
                         const std::filesystem::path& file) {
    return key.sign(bytes,
                    fmt::format("serial:{}\tfile:{}\thashed", serial, printable(file.filename().string())));
}

/// Refuses packs that the kiosk would refuse in spite of the signature.
Result<void> check_sound(std::span<const std::byte> bytes) {
    const Result<VerifiedPack> pack = verify_pack(bytes);
    return pack ? check_set_and_spoken(**pack) : tl::unexpected<Error>(pack.error());
}

Result<std::uint64_t> sign_pack(const SignRequest& request, const SecretKey& key, const std::string& file) {
    const Result<Bytes> pack = read_file(file, pack_format::most_pack_bytes);
    if (!pack) {
        return tl::unexpected<Error>(pack.error());
    }
    if (const Result<void> sound = check_sound(*pack); !sound) {
        return at(file, sound.error());
    }
    auto zip = pack_format::ZipReader::open(*pack);
    const Result<Bytes> manifest = zip.and_then(pack_format::read_manifest_bytes);
    const Result<std::optional<std::string>> before = zip.and_then(pack_format::read_signature_entry);
    if (!manifest || !before) {
        return at(file, !manifest ? manifest.error() : before.error());
    }
    const Result<std::uint64_t> serial = serial_for(request, *before);
    if (!serial) {
        return at(file, serial.error());
    }
    const Result<Bytes> with = with_signature(*pack, signature_of(key, *manifest, *serial, file));
    if (!with) {
        return at(file, with.error());
    }
    return write_file(file, *with).map([&] { return *serial; });
}

Result<std::uint64_t> sign_set_file(const SignRequest& request, const SecretKey& key,
                                    const std::string& file) {
    const Result<Bytes> text = read_file(file, most_exhibit_file_bytes);
    if (!text) {
        return tl::unexpected<Error>(text.error());
    }
    if (const Result<ExhibitFile> sound = parse_exhibit_file(as_text(*text)); !sound) {
        return at(file, sound.error());
    }
    const std::string beside = file + ".minisig";
    const Result<Bytes> before = read_file(beside, pack_format::most_signature_bytes);
    const Result<std::uint64_t> serial =
        serial_for(request, before ? std::optional<std::string>(as_text(*before)) : std::nullopt);
    if (!serial) {
        return at(file, serial.error());
    }
    return write_file(beside, as_bytes(signature_of(key, *text, *serial, file))).map([&] { return *serial; });
}

Result<std::uint64_t> sign_file(const SignRequest& request, const SecretKey& key, const std::string& file) {
    return file.ends_with(".toml") ? sign_set_file(request, key, file) : sign_pack(request, key, file);
}

} // namespace

int sign_files(const SignRequest& request) {
    const Result<SecretKey> key = read_secret_key(request.key);
    if (!key) {
        return exit_status("frustumscreen-pack", tl::unexpected<Error>(key.error()));
    }
    const std::string id = text_of_key_id(key->public_key().id);
    auto report = nlohmann::ordered_json::array();
    int status = 0;
    for (const std::string& file : request.files) {
        const Result<std::uint64_t> serial = sign_file(request, *key, file);
        if (!serial) {
            status = exit_status("frustumscreen-pack", tl::unexpected<Error>(serial.error()));
            report.push_back({{"file", file}, {"signed", false}, {"reason", serial.error().message}});
            continue;
        }
        report.push_back({{"file", file}, {"signed", true}, {"key_id", id}, {"serial", *serial}});
        if (!request.json) {
            fmt::print("{}: signed with the key {}, serial {}\n", file, id, *serial);
        }
    }
    if (request.json) {
        fmt::print("{}\n", report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
    }
    return status;
}

} // namespace frustumscreen
