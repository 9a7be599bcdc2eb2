// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "Support/TemporaryFolder.h"

namespace myotet::testing {

/// A program that was started, with its output in files.
class Program {
public:
    Program(const std::string& program, const std::vector<std::string>& arguments) {
        std::vector<std::string> words = {program};
        words.insert(words.end(), arguments.begin(), arguments.end());
        std::vector<char*> argv;
        for (std::string& word : words) argv.push_back(word.data());
        argv.push_back(nullptr);
        const std::string out = folder_ / "out", err = folder_ / "err";
        pid_ = ::fork();
        if (pid_ < 0) throw std::runtime_error("cannot fork");
        if (pid_ == 0) {  // only calls that are safe after a fork
            const int flags = O_CREAT | O_WRONLY | O_TRUNC;
            ::dup2(::open(out.c_str(), flags, 0600), STDOUT_FILENO);
            ::dup2(::open(err.c_str(), flags, 0600), STDERR_FILENO);
            ::execv(argv[0], argv.data());
            ::_exit(127);
        }
    }
    ~Program() {
        if (pid_ > 0) {
            ::kill(pid_, SIGKILL);
            ::waitpid(pid_, nullptr, 0);
        }
    }
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    void send(int signal) { ::kill(pid_, signal); }
    /// The exit code, or 128 + the signal that ended it.
    int wait() {
        int status = 0;
        ::waitpid(pid_, &status, 0);
        pid_ = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }
    [[nodiscard]] std::string out() const { return read_bytes(folder_ / "out"); }
    [[nodiscard]] std::string err() const { return read_bytes(folder_ / "err"); }

private:
    TemporaryFolder folder_;
    pid_t pid_ = -1;
};

struct Ran {
    int code = -1;
    std::string out, err;
};

inline Ran run_program(const std::string& program, const std::vector<std::string>& arguments) {
    Program running(program, arguments);
    const int code = running.wait();
    return {code, running.out(), running.err()};
}

}  // namespace myotet::testing
