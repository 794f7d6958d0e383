#include "app/programs/pack/keygen_command.h"

#include "app/pack/signature/secret_key.h"
#include "app/programs/pack/password_prompt.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <optional>

namespace frustumscreen::programs {

namespace {

tl::unexpected<Error> not_written(const std::string& file) {
    return bad_input("key.not_written", "{}: cannot be written: {}", file, std::strerror(errno));
}

Result<void> check_free(const std::string& file) {
    struct stat status {};
    if (::lstat(file.c_str(), &status) == 0) {
        return bad_input("key.there_already",
                         "{}: this key exists, and keys are never replaced; choose another name", file);
    }
    return {};
}

/// Writes a file that must not exist yet, with its final permissions from the first byte on.
Result<void> write_new_file(const std::string& file, mode_t mode, std::string_view text) {
    const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    if (descriptor < 0) {
        return errno == EEXIST ? check_free(file) : not_written(file);
    }
    const bool written = ::write(descriptor, text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
                         ::fsync(descriptor) == 0;
    const Result<void> result = written ? Result<void>() : not_written(file);
    ::close(descriptor);
    if (!written) {
        ::unlink(file.c_str());
    }
    return result;
}

Result<std::optional<Password>> password_for_new_key() {
    if (!is_at_terminal()) {
        return std::optional<Password>();
    }
    TRY(Password password, ask_new_password());
    return password.view().empty() ? std::optional<Password>() : std::optional<Password>(std::move(password));
}

Result<void> write_keys(const std::string& name, std::optional<std::string_view> password) {
    const pack::SecretKey key = pack::SecretKey::make();
    TRY(const std::string secret, pack::write_secret_key(key, password));
    TRY_VOID(write_new_file(name + ".key", 0600, secret));
    if (Result<void> written = write_new_file(name + ".pub", 0644, pack::write_public_key(key.public_key()));
        !written) {
        ::unlink((name + ".key").c_str()); // half a pair is useless
        return written;
    }
    fmt::print("{0}.key: the secret key{1}; keep it and a copy in a locked place\n{0}.pub: the public key, "
               "for the kiosk's settings:\n  [[exhibit.keys]]\n  name = \"{0}\"\n  public_key = \"{2}\"\n",
               name,
               password ? ", encrypted with your password"
                        : " without a password, so anyone who can read the file can sign packs",
               pack::public_key_line(key.public_key()));
    return {};
}

} // namespace

Result<void> make_keys(const std::string& name) {
    for (const char* ending : {".key", ".pub"}) { // before the password is asked for
        TRY_VOID(check_free(name + ending));
    }
    TRY(const std::optional<Password> password, password_for_new_key());
    return write_keys(name, password ? std::optional(password->view()) : std::nullopt);
}

} // namespace frustumscreen::programs
