// TRY gives the value of a result; TRY_VOID discards it. Both return the error from the enclosing function.
#include "firmware_host/base/result.h"
#include "tests/base/told.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace frustumscreen {
namespace {

const Error torn{ErrorKind::DeviceLost, "cable.torn", "cable: torn; put in another"};

Result<int> number(bool good) {
    return good ? Result<int>(7) : tl::unexpected(torn);
}
Result<void> step(bool good) {
    return good ? Result<void>() : tl::unexpected(torn);
}
Result<std::unique_ptr<int>> owned(bool good) {
    return good ? Result<std::unique_ptr<int>>(std::make_unique<int>(7)) : tl::unexpected(torn);
}

template <typename T> void expect_torn(const Result<T>& result) {
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().kind, torn.kind);
    EXPECT_EQ(result.error().id, "cable.torn");
    EXPECT_EQ(result.error().message, torn.message);
}

TEST(Result, TryYieldsTheValueOrReturnsTheError) {
    const auto as_text = [](bool good) -> Result<std::string> {
        TRY(const int seven, number(good));
        return std::to_string(seven);
    };
    EXPECT_EQ(as_text(true).value(), "7");
    expect_torn(as_text(false));
}

TEST(Result, TryAssignsToAnExistingVariableOnlyOnSuccess) {
    std::vector<int> numbers{1, 2};
    const auto assign = [&](bool good) -> Result<void> {
        TRY(numbers.at(1), number(good));
        return {};
    };
    expect_torn(assign(false));
    EXPECT_EQ(numbers, (std::vector{1, 2}));
    EXPECT_TRUE(assign(true));
    EXPECT_EQ(numbers, (std::vector{1, 7}));
}

TEST(Result, TryVoidContinuesOrReturnsTheError) {
    int steps = 0;
    const auto walk = [&](bool good) -> Result<std::string> {
        TRY_VOID(step(true));
        ++steps;
        TRY_VOID(step(good));
        ++steps;
        return "there";
    };
    EXPECT_EQ(walk(true).value(), "there");
    EXPECT_EQ(steps, 2);
    expect_torn(walk(false));
    EXPECT_EQ(steps, 3);
}

TEST(Result, TryMovesTheValueOut) {
    const auto pass = [](bool good) -> Result<std::unique_ptr<int>> {
        TRY(std::unique_ptr<int> seven, owned(good));
        return seven;
    };
    EXPECT_EQ(*pass(true).value(), 7);
    expect_torn(pass(false));
}

TEST(Result, TryCopiesFromANamedResult) {
    const Result<std::string> named = "seven";
    const auto pass = [&]() -> Result<std::string> {
        TRY(std::string text, named);
        return text;
    };
    EXPECT_EQ(pass().value(), "seven");
    EXPECT_EQ(named.value(), "seven");
}

TEST(Result, TryVoidLeavesANamedResultUnchanged) {
    Result<std::unique_ptr<int>> named = owned(true);
    Result<void> late = step(false);
    const auto pass = [&]() -> Result<void> {
        TRY_VOID(named);
        TRY_VOID(late);
        return {};
    };
    expect_torn(pass());
    EXPECT_EQ(**named, 7);
    expect_torn(late);
}

TEST(Result, AllowsManyTriesInOneScopeAndLine) {
    const auto sum = [](bool good) -> Result<int> {
        // clang-format off
        TRY(const int a, number(true)); TRY(const int b, number(good)); TRY_VOID(step(true)); TRY_VOID(step(true));
        // clang-format on
        TRY(const int c, [&]() -> Result<int> {
            TRY(const int inner, number(good));
            return inner + 1;
        }());
        return a + b + c;
    };
    EXPECT_EQ(sum(true).value(), 22);
    expect_torn(sum(false));
}

TEST(Result, TryVoidRejectsOwningTemporaries) {
    static_assert(may_be_dropped<Result<void>&&> && may_be_dropped<Result<int>&&>);
    static_assert(!may_be_dropped<Result<std::unique_ptr<int>>&&> && !may_be_dropped<Result<std::string>&&>);
    static_assert(may_be_dropped<Result<std::unique_ptr<int>>&> &&
                  may_be_dropped<const Result<std::string>&>);
    const auto check = [](bool good) -> Result<void> {
        TRY_VOID(without_value(owned(good)));
        return {};
    };
    EXPECT_TRUE(check(true));
    expect_torn(check(false));
}

TEST(Result, TryEvaluatesItsExpressionOnce) {
    int calls = 0;
    const auto count = [&](bool good) {
        ++calls;
        return number(good);
    };
    const auto run = [&](bool good) -> Result<void> {
        TRY(const int seven, count(good));
        EXPECT_EQ(seven, 7);
        TRY_VOID(count(good));
        return {};
    };
    EXPECT_TRUE(run(true));
    EXPECT_EQ(calls, 2);
    expect_torn(run(false));
    EXPECT_EQ(calls, 3);
}

TEST(Result, TryReturnsErrorsOfOtherTypes) {
    const auto wait = [](bool good) -> tl::expected<int, char> {
        return good ? tl::expected<int, char>(7) : tl::unexpected('!');
    };
    const auto pass = [&](bool good) -> tl::expected<std::string, char> {
        TRY(const auto seven, wait(good));
        return std::to_string(seven);
    };
    EXPECT_EQ(pass(true).value(), "7");
    EXPECT_EQ(pass(false).error(), '!');
}

TEST(Result, AtPrefixesErrorsWithThePlace) {
    EXPECT_EQ(at("stand", number(true)).value(), 7);
    EXPECT_TRUE(at("stand", step(true)));
    EXPECT_EQ(*at("stand", owned(true)).value(), 7);
    const Result<int> lost = at("stand", number(false));
    ASSERT_FALSE(lost);
    EXPECT_EQ(lost.error().kind, torn.kind);
    EXPECT_EQ(lost.error().id, "cable.torn") << "the id stays";
    EXPECT_EQ(lost.error().message, "stand: cable: torn; put in another");
}

TEST(Result, FailFormatsTheSentenceAndKeepsTheId) {
    const Result<int> lost = fail(ErrorKind::Internal, "cable.count", "{} of {} cables", 3, "nine");
    ASSERT_FALSE(lost);
    EXPECT_EQ(test::told(lost.error()), "3 of nine cables [cable.count]");
    EXPECT_EQ(lost.error().kind, ErrorKind::Internal);
    const Result<int> braces = bad_input("cable.braces", "an object { ... }");
    EXPECT_EQ(braces.error().message, "an object { ... }") << "without arguments nothing is formatted";
    const Result<int> moved = as_kind(ErrorKind::BadConfiguration, braces.error());
    EXPECT_EQ(moved.error().id, "cable.braces");
    EXPECT_EQ(moved.error().kind, ErrorKind::BadConfiguration);
}

} // namespace
} // namespace frustumscreen
