// SPDX-License-Identifier: Apache-2.0
#include "SlicerModule.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>

#include "Report/Html.h"

namespace myotet::app {
namespace {

using report::escaped;

std::string element(const std::string& name, const std::string& text) {
    return "<" + name + ">" + escaped(text) + "</" + name + ">\n";
}

// "edge-length" -> "edge_length": names are those of variables.
std::string variable(std::string name) {
    std::ranges::replace(name, '-', '_');
    return name;
}

std::string name_of(const CLI::Option& option) {
    return option.get_positional() ? variable(CLI::detail::to_lower(option.get_name(true)))
                                   : variable(option.get_lnames().front());
}

// "edge-length" -> "Edge length"
std::string title_of(const CLI::Option& option) {
    std::string title = option.get_positional() ? CLI::detail::to_lower(option.get_name(true))
                                                : option.get_lnames().front();
    std::ranges::replace(title, '-', ' ');
    if (!title.empty()) title[0] = static_cast<char>(std::toupper(title[0]));
    return title;
}

// The words "{fem,springs}" that an option takes one of.
std::vector<std::string> choices_of(CLI::Option& option) {
    if (option.get_expected_max() > 1) return {};
    for (int i = 0;; ++i) {
        try {
            const CLI::Validator& rule = *option.get_validator(i);
            for (const std::string& said : {rule.get_name(), rule.get_description()})
                if (said.size() > 2 && said.front() == '{')
                    return CLI::detail::split(said.substr(1, said.size() - 2), ',');
        } catch (const CLI::OptionNotFound&) {
            return {};
        }
    }
}

// What stands behind "(default: " in its help, up to its end.
std::string default_of(const CLI::Option& option) {
    if (!option.get_default_str().empty()) return option.get_default_str();
    const std::string& help = option.get_description();
    const std::string mark = "(default: ";
    const std::size_t at = help.find(mark);
    if (at == std::string::npos) return "";
    const std::size_t begin = at + mark.size();
    return help.substr(begin, help.find_first_of(";,)", begin) - begin);
}

bool takes_file(const std::string& type) {
    constexpr std::array kinds = {"FILE", "TABLE", "RECIPE", "MOTION"};
    return std::ranges::find(kinds, type) != kinds.end() || type.find('.') != std::string::npos;
}

struct Parameter {
    std::string tag, attributes, value, choices;
};

Parameter parameter_for(CLI::Option& option) {
    const std::string type = option.get_type_name();
    if (option.get_expected_min() == 0) return {"boolean", "", "false", ""};
    if (option.get_positional() && option.get_description().starts_with("labels"))
        return {"image", " type=\"label\"", "", ""};
    if (type == "FOLDER") return {"directory", "", "", ""};
    if (takes_file(type)) return {"file", "", "", ""};
    const std::vector<std::string> choices = choices_of(option);
    const std::string usual = default_of(option);
    if (std::ranges::find(choices, usual) == choices.end()) return {"string", "", "", ""};
    Parameter parameter{"string-enumeration", "", usual, ""};
    for (const std::string& word : choices) parameter.choices += element("element", word);
    return parameter;
}

std::string to_xml(CLI::Option& option, int index) {
    const Parameter parameter = parameter_for(option);
    std::string xml = "<" + parameter.tag + parameter.attributes + ">\n";
    xml += element("name", name_of(option)) + element("label", title_of(option)) +
           element("description", option.get_description());
    if (option.get_positional()) {
        xml += element("index", std::to_string(index));
    } else {
        xml += element("longflag", "--" + option.get_lnames().front());
    }
    if (parameter.tag == "image" || parameter.tag == "file" || parameter.tag == "directory") {
        const bool result = name_of(option) == "output" ||
                            option.get_description().starts_with("folder for the results");
        xml += element("channel", result ? "output" : "input");
    }
    if (!parameter.value.empty()) xml += element("default", parameter.value);
    return xml + parameter.choices + "</" + parameter.tag + ">\n";
}

std::string group(const std::string& label, const std::string& what, const std::string& inside) {
    if (inside.empty()) return "";
    const std::string advanced = label == "Messages" ? " advanced=\"true\"" : "";
    return "<parameters" + advanced + ">\n" + element("label", label) +
           element("description", what) + inside + "</parameters>\n";
}

bool is_message(const std::string& name) {
    constexpr std::array names = {"threads", "json", "quiet", "verbose"};
    return std::ranges::find(names, name) != names.end();
}

// How Myotet is to talk when Slicer runs it.
std::string telling() {
    return "<string-enumeration>\n" + element("name", "progress") + element("label", "Progress") +
           element("description", "in whose words progress is told; slicer for Slicer") +
           element("longflag", "--progress") + element("default", "slicer") +
           element("element", "slicer") + element("element", "text") + "</string-enumeration>\n";
}

}  // namespace

std::string slicer_description(const CLI::App& command) {
    std::string files, options, messages;
    int index = 0;
    for (const CLI::Option* listed : command.get_options()) {
        // What checks an option is only shown by one that may be changed.
        auto& option = const_cast<CLI::Option&>(*listed);
        if (!option.get_positional()) {
            const std::string& name = option.get_lnames().front();
            if (name == "help" || name == "xml" || name == "progress") continue;
            std::string& where = is_message(name)        ? messages
                                 : option.get_required() ? files
                                                         : options;
            where += to_xml(option, 0);
        } else {
            files += to_xml(option, index++);
        }
    }
    return "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<executable>\n" +
           element("category", "Myotet") + element("title", "Myotet: " + command.get_name()) +
           element("description", command.get_description()) + element("version", MYOTET_VERSION) +
           element("license", "Apache-2.0") +
           group("Input and output", "Files and folders", files) +
           group("Options", "What is left empty is found from the input, as each description says", options) +
           group("Messages", "What is said, and threads", messages + telling()) + "</executable>";
}

}  // namespace myotet::app
