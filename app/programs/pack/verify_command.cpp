#include "app/programs/pack/verify_command.h"

#include "app/pack/attribution.h"
#include "app/pack/container/limits.h"
#include "app/pack/pack_file.h"
#include "app/pack/pack_relief.h"
#include "app/pack/pack_states.h"
#include "app/pack/pack_texts.h"
#include "app/pack/pack_torches.h"
#include "app/pack/pack_world.h"
#include "app/pack/signature/key_folder.h"
#include "app/pack/signed_pack.h"
#include "app/programs/common/guarded_main.h"
#include "firmware_host/base/json.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

namespace frustumscreen::programs {

namespace {

using Json = nlohmann::ordered_json;

/// A pack that passed all requested checks.
struct SoundPack {
    pack::VerifiedPack pack;
    std::optional<pack::SignatureClaim> claim; ///< none: unsigned
    std::string signer;                        ///< empty: the signature was not checked
};

Result<std::vector<pack::TrustedKey>> read_keys(const std::vector<std::filesystem::path>& files) {
    std::vector<pack::TrustedKey> keys;
    for (const std::filesystem::path& file : files) {
        TRY(const pack::PublicKey key, pack::read_public_key(file));
        keys.push_back({file.stem().string(), key, std::nullopt});
    }
    return keys;
}

/// With keys, verifies the signature before anything else of the pack is parsed.
Result<std::pair<pack::PackReader, std::string>> open_checked(OpenFile file,
                                                              std::span<const pack::TrustedKey> keys) {
    if (keys.empty()) {
        return pack::PackReader::open(std::move(file)).map([](pack::PackReader&& reader) {
            return std::pair(std::move(reader), std::string());
        });
    }
    tl::expected<pack::SignedPack, pack::PackRefusal> opened =
        pack::open_signed_pack(std::move(file), {keys, std::nullopt, pack::UnsignedPacks::Refuse});
    if (!opened) {
        return tl::unexpected<Error>(std::move(opened.error().error));
    }
    return std::pair(std::move(opened->reader), std::move(opened->signer->key));
}

Result<SoundPack> check(const std::string& file, std::span<const pack::TrustedKey> keys) {
    if (std::error_code none; std::filesystem::is_directory(file, none)) {
        return bad_input("verify.folder", file + ": this is a folder; name the *.fspack files in it");
    }
    TRY(OpenFile opened, OpenFile::open(file, pack::max_pack_bytes));
    TRY(auto reader, at(file, open_checked(std::move(opened), keys)));
    TRY(std::optional<pack::SignatureClaim> claim, at(file, pack::claim_of(reader.first)));
    Result<pack::VerifiedPack> pack = pack::read_pack(reader.first);
    const Result<void> good = pack.and_then([](const pack::VerifiedPack& read) {
        return pack::check_set_and_spoken(*read)
            .and_then([&] { return pack::check_reliefs(*read); })
            .and_then([&] { return pack::check_torches(*read); })
            .and_then([&] { return pack::check_world(*read); })
            .and_then([&] { return without_value(pack::states_of(*read)); })
            .and_then([&] { return without_value(pack::scan_rights(*read)); });
    });
    TRY_VOID(at(file, good));
    return SoundPack{*std::move(pack), std::move(claim), std::move(reader.second)};
}

std::string signature_words(const SoundPack& sound) {
    if (!sound.claim) {
        return "unsigned";
    }
    return sound.signer.empty()
               ? fmt::format("signed with the key {}, serial {}, not checked (name its --key)",
                             sound.claim->key_id, sound.claim->serial)
               : fmt::format("signed by {}, serial {}", printable(sound.signer), sound.claim->serial);
}

Json report_of(const std::string& file, const SoundPack& sound) {
    Json json{{"file", file}, {"sound", true}, {"signed", sound.claim.has_value()}};
    if (sound.claim) {
        json["checked"] = !sound.signer.empty();
        json["key"] = sound.signer.empty() ? Json(nullptr) : Json(sound.signer);
        json["key_id"] = sound.claim->key_id;
        json["serial"] = sound.claim->serial;
        json["trusted_comment"] = sound.claim->trusted_comment;
    }
    return json;
}

} // namespace

int verify_packs(const VerifyRequest& request) {
    const Result<std::vector<pack::TrustedKey>> keys = read_keys(request.keys);
    if (!keys) {
        return exit_status("frustumscreen-pack", tl::unexpected<Error>(keys.error()));
    }
    int status = 0;
    Json report = Json::array();
    for (const std::string& file : request.packs) {
        const Result<SoundPack> sound = check(file, *keys);
        if (!sound) {
            status = exit_status("frustumscreen-pack", tl::unexpected<Error>(sound.error()));
            report.push_back({{"file", file},
                              {"sound", false},
                              {"signed", false},
                              {"id", sound.error().id.view()},
                              {"reason", sound.error().message}});
            continue;
        }
        report.push_back(report_of(file, *sound));
        if (!request.json) {
            fmt::print("{}: intact, {}, {} levels, \"{}\"\n", file, signature_words(*sound),
                       sound->pack->levels.size(), sound->pack->title);
        }
    }
    if (request.json) {
        fmt::print("{}\n", report.dump(2, ' ', false, Json::error_handler_t::replace));
    }
    return status;
}

} // namespace frustumscreen::programs
