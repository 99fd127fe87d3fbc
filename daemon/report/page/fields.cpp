#include "daemon/report/page/fields.hpp"

namespace loopscope::daemon {

Value::Value(bool yes) : variant(yes) {}
Value::Value(int number) : Value(std::int64_t{number}) {}
Value::Value(std::int64_t number) : variant(number) {}
Value::Value(const char* text) : Value(std::string(text)) {}
Value::Value(std::string text) : variant(std::move(text)) {}
Value::Value(std::string_view text) : Value(std::string(text)) {}
Value::Value(Markup ready) : variant(std::move(ready)) {}
Value::Value(Fields fields) : variant(std::move(fields)) {}
Value::Value(List list) : variant(std::move(list)) {}
Value::Value(const std::vector<std::string>& texts) : Value(List(texts.begin(), texts.end())) {}
Value::Value(const std::vector<Markup>& parts) : Value(List(parts.begin(), parts.end())) {}

}  // namespace loopscope::daemon
