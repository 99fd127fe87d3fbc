# Writes OUTPUT, a source file that holds page.css, page.js and the script of FOLDER/trend with their
# digests, which a page's Content-Security-Policy names, and the templates of FOLDER/templates.

# `text` as a raw string, which ends where its delimiter stands.
function(raw_string result file text)
  string(FIND "${text}" ")page_asset\"" ending)
  if(NOT ending EQUAL -1)
    message(FATAL_ERROR "${file} holds the delimiter of the string that it is put into")
  endif()
  set(${result} "R\"page_asset(${text})page_asset\"" PARENT_SCOPE)
endfunction()

function(read_asset result file)
  file(READ ${FOLDER}/${file} text)
  file(SHA256 ${FOLDER}/${file} digest)
  raw_string(string ${file} "${text}")
  set(${result} "{${string}, \"${digest}\"}" PARENT_SCOPE)
endfunction()

# The files of FOLDER/trend as one script with names of its own; trend.js, which starts it, is the last.
function(read_trend result)
  set(script "(function () {\n\"use strict\";\n\n")
  foreach(name samples clock view scale paint controls trend)
    file(READ ${FOLDER}/trend/${name}.js text)
    string(APPEND script "${text}\n")
  endforeach()
  string(APPEND script "})();\n")
  string(SHA256 digest "${script}")
  raw_string(string trend "${script}")
  set(${result} "{${string}, \"${digest}\"}" PARENT_SCOPE)
endfunction()

function(read_template result file)
  file(READ ${file} text)
  raw_string(string ${file} "${text}")
  get_filename_component(name ${file} NAME_WE)
  set(${result} "    {\"${name}\", ${string}},\n" PARENT_SCOPE)
endfunction()

read_asset(style page.css)
read_asset(script page.js)
read_trend(trend)
set(templates "")
file(GLOB files ${FOLDER}/templates/*.html)
foreach(file IN LISTS files)
  read_template(template ${file})
  string(APPEND templates "${template}")
endforeach()

file(WRITE ${OUTPUT} "#include \"daemon/report/page/page_assets.hpp\"

namespace loopscope::daemon {
namespace {

constexpr PageTemplate kTemplates[] = {
${templates}};

}  // namespace

PageAsset page_style() {
  return ${style};
}

PageAsset page_script() {
  return ${script};
}

PageAsset trend_script() {
  return ${trend};
}

std::span<const PageTemplate> page_templates() {
  return kTemplates;
}

}  // namespace loopscope::daemon
")
