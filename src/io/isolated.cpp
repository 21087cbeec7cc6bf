// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The child of a fork works and sends one byte, a verdict, and then its result or its sentence through a pipe. It never
// returns into the program: it ends by _exit, so that nothing of the parent is flushed or destroyed twice.

#include "io/isolated.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <fcntl.h>
#include <fmt/format.h>
#include <optional>
#include <span>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

#include "io/text.hpp"

#include "mien/error.hpp"

namespace mien {

namespace {

constexpr std::byte done{0}, refused{1};

[[noreturn]] void cannot_start(std::string_view name) {
    throw Error(
        fmt::format("{}: cannot start a process to read it in: {}", name, std::generic_category().message(errno)),
        Error::Kind::access);
}

// Bytes of private memory that this process has, as RLIMIT_DATA counts them; nothing where the system does not tell.
std::optional<std::uint64_t> allocated() {
    std::FILE* file = std::fopen("/proc/self/statm", "r");
    if (file == nullptr) return std::nullopt;
    std::array<char, 256> text{};
    const std::size_t size = std::fread(text.data(), 1, text.size() - 1, file);
    std::fclose(file);
    Words words(std::string_view(text.data(), size));
    std::string_view word;
    constexpr int data_and_stack = 6;
    for (int n = 0; n < data_and_stack; ++n) word = words.next();
    const auto pages = parse_integer(word);
    if (!pages || *pages < 0) return std::nullopt;
    return static_cast<std::uint64_t>(*pages) * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

void limit(decltype(RLIMIT_CPU) what, std::uint64_t most) {
    const rlimit value{most, most};
    setrlimit(what, &value);
}

// The sanitizers' own memory would be counted too.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool counts_memory = false;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
constexpr bool counts_memory = false;
#else
constexpr bool counts_memory = true;
#endif
#else
constexpr bool counts_memory = true;
#endif

void confine(const IsolatedLimits& limits) {
    for (const int signal : {SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSEGV, SIGTRAP, SIGXCPU}) std::signal(signal, SIG_DFL);
    std::signal(SIGPIPE, SIG_IGN);
    const int nowhere = open("/dev/null", O_RDWR);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, stream);
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, limits.seconds);
    const auto had = allocated();
    if (counts_memory && had) limit(RLIMIT_DATA, *had + limits.memory);
}

void send(int pipe, std::byte verdict, std::span<const std::byte> bytes) {
    if (write(pipe, &verdict, 1) != 1) return;
    while (!bytes.empty()) {
        const ssize_t sent = write(pipe, bytes.data(), bytes.size());
        if (sent < 0 && errno == EINTR) continue;
        if (sent <= 0) return;
        bytes = bytes.subspan(static_cast<std::size_t>(sent));
    }
}

[[noreturn]] void work_and_end(int pipe, const IsolatedLimits& limits,
                               const std::function<std::vector<std::byte>()>& work) {
    try {
        confine(limits);
        send(pipe, done, work());
    } catch (const std::bad_alloc&) {
        send(pipe, refused, as_bytes("expected a file that fits into the memory it may take, found a larger one"));
    } catch (const std::exception& error) {
        send(pipe, refused, as_bytes(std::string_view(error.what())));
    } catch (...) {
        send(pipe, refused, as_bytes("expected a file that can be read, found another"));
    }
    _exit(0);
}

std::vector<std::byte> receive(int pipe, std::uint64_t most) {
    constexpr std::size_t chunk = std::size_t{1} << 16;
    std::vector<std::byte> bytes;
    while (bytes.size() <= most) {
        const std::size_t size = bytes.size();
        bytes.resize(size + chunk);
        const ssize_t got = read(pipe, bytes.data() + size, chunk);
        bytes.resize(size + static_cast<std::size_t>(got > 0 ? got : 0));
        if (got == 0 || (got < 0 && errno != EINTR)) break;
    }
    return bytes;
}

int ended(pid_t child) {
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
}

}  // namespace

std::vector<std::byte> run_isolated(std::string_view name, const IsolatedLimits& limits,
                                    const std::function<std::vector<std::byte>()>& work) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) cannot_start(name);
    const pid_t child = fork();
    if (child < 0) {
        close(ends[0]);
        close(ends[1]);
        cannot_start(name);
    }
    if (child == 0) {
        close(ends[0]);
        work_and_end(ends[1], limits, work);
    }
    close(ends[1]);
    std::vector<std::byte> bytes = receive(ends[0], limits.memory);
    close(ends[0]);
    const int status = ended(child);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || bytes.empty())
        throw Error(fmt::format("{}: expected a file that can be read within {} s and {} MB, found one that cannot",
                                name, limits.seconds, limits.memory >> 20U));
    const std::byte verdict = bytes.front();
    bytes.erase(bytes.begin());
    if (verdict != done) throw Error(std::string(as_text(bytes)));
    return bytes;
}

}  // namespace mien
