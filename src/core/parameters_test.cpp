// SPDX-License-Identifier: MIT
// Parameters by name: what is accepted, and the sentences of what is not.
#include "core/parameters.h"

#include <gtest/gtest.h>

#include "core/error.h"

using namespace luxel;

namespace {

enum class Mode { thesis, calibrated };

struct Sample {
    float radius = 0.5f;
    int samples = 80;
    bool blur = true;
    std::string label = "none";
    Mode mode = Mode::calibrated;
    void visit(Visitor& visitor) {
        visitor.real("radius", radius, {0.1, 2.0}, "world radius");
        visitor.integer("samples", samples, {1, 256}, "taps per pixel");
        visitor.flag("blur", blur, "filter the result");
        visitor.text("label", label, "free text");
        visitor.choice("mode", mode, {"thesis", "calibrated"}, "estimator");
    }
};

std::string refusal(const std::vector<std::pair<std::string, std::string>>& values) {
    Sample sample;
    try {
        set_parameters(sample, "isr", values);
    } catch (const Error& error) {
        EXPECT_EQ(error.fault(), Fault::usage);
        return error.what();
    }
    return "";
}

} // namespace

TEST(Parameters, SpecificationIsSplit) {
    const Specification specification = parse_specification("isr:samples=80,mode=thesis,label=");
    EXPECT_EQ(specification.name, "isr");
    const std::vector<std::pair<std::string, std::string>> expected = {
        {"samples", "80"}, {"mode", "thesis"}, {"label", ""}};
    EXPECT_EQ(specification.values, expected);
    EXPECT_TRUE(parse_specification("isr").values.empty());
    for (const char* wrong :
         {"", ":a=1", "isr:", "isr:a", "isr:a=1,", "isr:=1", "isr:a=1,,b=2", "isr:a=1,a=2"})
        EXPECT_THROW(parse_specification(wrong), Error) << wrong;
}

TEST(Parameters, EveryTypeIsSet) {
    Sample sample;
    set_parameters(
        sample, "isr",
        {{"radius", "0.1"}, {"samples", "256"}, {"blur", "off"}, {"label", "a b"}, {"mode", "thesis"}});
    EXPECT_EQ(sample.radius, 0.1f);
    EXPECT_EQ(sample.samples, 256);
    EXPECT_FALSE(sample.blur);
    EXPECT_EQ(sample.label, "a b");
    EXPECT_EQ(sample.mode, Mode::thesis);
}

TEST(Parameters, RefusalsSayWhatIsAllowed) {
    EXPECT_EQ(
        refusal({{"sample", "3"}}),
        "isr: no parameter sample; known are radius, samples, blur, label, mode; did you mean samples?");
    EXPECT_EQ(refusal({{"samples", "0"}}),
              "isr: parameter samples cannot be \"0\"; it is an integer from 1 to 256");
    EXPECT_EQ(
        refusal({{"mode", "tesis"}}),
        "isr: parameter mode cannot be \"tesis\"; it is one of thesis, calibrated; did you mean thesis?");
    EXPECT_EQ(refusal({{"mode", "x"}}),
              "isr: parameter mode cannot be \"x\"; it is one of thesis, calibrated");
    for (const char* wrong : {"", "1x", "nan", "inf", "0.05", "2.1", " 1"})
        EXPECT_NE(refusal({{"radius", wrong}}), "") << wrong;
    for (const char* wrong : {"1.5", "257", "99999999999999999999", "-1"})
        EXPECT_NE(refusal({{"samples", wrong}}), "") << wrong;
    EXPECT_NE(refusal({{"blur", "maybe"}}), "");
}

TEST(Parameters, AreListedWithTheirValues) {
    Sample sample;
    const std::vector<ParameterInfo> list = parameters_of(sample);
    ASSERT_EQ(list.size(), 5u);
    EXPECT_EQ(list[0].value, "0.5");
    EXPECT_EQ(list[0].allowed, "0.1 to 2");
    EXPECT_EQ(list[2].value, "on");
    EXPECT_EQ(list[4].value, "calibrated");
    EXPECT_EQ(list[4].allowed, "thesis, calibrated");
    EXPECT_EQ(list[4].meaning, "estimator");
}
