// SPDX-License-Identifier: Apache-2.0
#include "Skeleton/OsimFunctions.h"

#include "Core/Errors.h"

namespace myotet::skeleton {
namespace {

Function through_points(const OsimFile& file, const XmlElement& element,
                        Function make(std::vector<double>, std::vector<double>)) {
    const XmlElement* x = file.property(element, "x");
    const XmlElement* y = file.property(element, "y");
    if (!x || !y) file.refuse(element, "has no <x> or no <y>; add both");
    try {
        return make(file.numbers(*x), file.numbers(*y));
    } catch (const InputError& error) {
        file.refuse(element, std::string(error.what()) + "; correct its <x> and <y>");
    }
}

Function with_coefficients(FunctionKind kind, std::vector<double> coefficients) {
    Function f;
    f.kind = kind;
    f.coefficients = std::move(coefficients);
    return f;
}

const XmlElement& coefficients_of(const OsimFile& file, const XmlElement& element) {
    const XmlElement* c = file.property(element, "coefficients");
    if (!c) file.refuse(element, "has no <coefficients>; add them");
    return *c;
}

Function polynomial(const OsimFile& file, const XmlElement& element) {
    auto c = file.numbers(coefficients_of(file, element));
    if (c.empty()) file.refuse(element, "has no coefficient; write at least one");
    return with_coefficients(FunctionKind::polynomial, std::move(c));
}

Function multiplied(const OsimFile& file, const XmlElement& element) {
    const XmlElement* inner = find_function(element, "function");
    if (!inner) file.refuse(element, "multiplies no <function>; add one");
    Function f = read_function(file, *inner);
    f.scale *= file.number(element, "scale", 1);
    return f;
}

/// A spline that smooths and one of another order than cubic is no function of ours; an exact
/// cubic one is natural [Woltring 1986].
Function gcv_spline(const OsimFile& file, const XmlElement& element) {
    if (file.number(element, "half_order", 3) != 2 ||
        file.number(element, "error_variance", 0) != 0)
        file.refuse(element,
                    "is read only with <half_order> 2 and <error_variance> 0, as a cubic through "
                    "its points; fit the curve again with these, or use a SimmSpline");
    return through_points(file, element, natural_spline);
}

}  // namespace

Function read_function(const OsimFile& file, const XmlElement& element) {
    const std::string& kind = element.kind;
    if (kind == "Constant") return constant_function(file.number(element, "value"));
    if (kind == "LinearFunction")
        return with_coefficients(FunctionKind::linear,
                                 file.numbers(coefficients_of(file, element), 2));
    if (kind == "PolynomialFunction") return polynomial(file, element);
    if (kind == "Sine")
        return with_coefficients(
            FunctionKind::sine,
            {file.number(element, "amplitude", 1), file.number(element, "omega", 1),
             file.number(element, "phase", 0), file.number(element, "offset", 0)});
    if (kind == "SimmSpline" || kind == "NaturalCubicSpline" || kind == "natCubicSpline")
        return through_points(file, element, simm_spline);
    if (kind == "PiecewiseLinearFunction") return through_points(file, element, piecewise_linear);
    if (kind == "MultiplierFunction") return multiplied(file, element);
    if (kind == "GCVSpline") return gcv_spline(file, element);
    file.refuse(element,
                "is a function of a kind that is not read; use Constant, LinearFunction, "
                "PolynomialFunction, Sine, SimmSpline, PiecewiseLinearFunction or "
                "MultiplierFunction");
}

const XmlElement* find_function(const XmlElement& of, std::string_view property) {
    for (const XmlElement& element : of.children) {
        if (element.kind == property)
            return element.children.empty() ? nullptr : &element.children.front();
        if (element.name == property) return &element;
    }
    return nullptr;
}

}  // namespace myotet::skeleton
