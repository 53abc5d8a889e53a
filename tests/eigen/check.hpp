// The least a self-checking program needs.

#pragma once

#include <cstdio>
#include <string>

class Checks {
public:
    // Also fails where the value is not a number.
    void at_most(const std::string &what, double value, double limit) {
        report(what + " = " + text(value) + " (at most " + text(limit) + ")", value <= limit);
    }

    void within(const std::string &what, double value, double low, double high) {
        report(what + " = " + text(value) + " (within " + text(low) + " ... " + text(high) + ")",
               value >= low && value <= high);
    }

    void is_true(const std::string &what, bool holds) { report(what, holds); }

    int exit_code() const {
        if (failures_ > 0) std::printf("%d of %d checks failed\n", failures_, count_);
        return failures_ > 0 ? 1 : 0;
    }

private:
    static std::string text(double x) {
        char buffer[32];
        std::snprintf(buffer, sizeof buffer, "%.4g", x);
        return buffer;
    }

    void report(const std::string &line, bool holds) {
        std::printf("%s  %s\n", holds ? "ok  " : "FAIL", line.c_str());
        ++count_;
        if (!holds) ++failures_;
    }

    int count_ = 0;
    int failures_ = 0;
};
