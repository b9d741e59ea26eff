// Requests and answers of HTTP as plain data, so that pages are made and tested without a socket.
#pragma once

#include <functional>
#include <map>
#include <string>

namespace bl::serve {

struct Request {
  std::string method, target, body;  ///< `target` as sent, with its query
  std::string host;                  ///< the field Host, or what a proxy says of it
  std::string scheme = "http";       ///< or https
  bool takes_gzip = false;
  bool is_local = false;  ///< from this computer itself
};

struct Response {
  int status = 200;
  std::string type = "text/html; charset=utf-8", body = {};
  std::map<std::string, std::string> fields = {};  ///< besides those that all answers have
  std::string inline_sources = {};                 ///< digests of the scripts and styles in the page itself that may run
};

using Reply = std::function<void(Response)>;

/// The fields of a form: `a=1&b=two+words`, with its escapes undone. A field that stands twice has its last value.
std::map<std::string, std::string> form_fields(const std::string& text);
/// A text as the value of a field of a form, in letters that may stand anywhere.
std::string form_text(std::string_view text);
/// The path without its query.
std::string path_of(const std::string& target);

}  // namespace bl::serve
