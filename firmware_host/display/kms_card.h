/// An open graphics card: its file, its name, and what is connected to it.
///
/// Threads  `look` on any one thread while the render thread sets modes: the kernel takes both.
/// Errors   no card, no permission, a card without screens or without atomic modesetting.
#pragma once

#include "firmware_host/base/result.h"
#include "firmware_host/display/kms_mode.h"

#include <string>
#include <string_view>

namespace frustumscreen {

class KmsCard {
public:
    /// `name`: a path, or "card1", or empty for the first one to which something is connected, else the
    /// first.
    [[nodiscard]] static Result<KmsCard> open(std::string_view name);
    ~KmsCard();
    KmsCard(KmsCard&& other) noexcept;
    KmsCard& operator=(KmsCard&& other) noexcept;
    KmsCard(const KmsCard&) = delete;
    KmsCard& operator=(const KmsCard&) = delete;

    [[nodiscard]] int file() const { return file_; }
    [[nodiscard]] const std::string& path() const { return path_; }
    /// What is connected. `thoroughly`: asks the projectors, which takes up to some 100 ms for each; else
    /// what the kernel knows already.
    [[nodiscard]] CardSeen look(bool thoroughly) const;

private:
    KmsCard(int file, std::string path) : file_(file), path_(path), wanted_(std::move(path)) {}
    [[nodiscard]] static Result<KmsCard> open_path(const std::string& path);
    [[nodiscard]] CardState state() const;

    int file_ = -1;
    std::string path_;
    std::string wanted_; ///< as asked for
};

/// Makes this process the one that may set modes on an open card: true if no other one is. The kernel lets
/// only the first who opened the card do so, and whoever once was it (drm_auth.c, drm_master_check_perm).
[[nodiscard]] bool take_screen(int card);

} // namespace frustumscreen
