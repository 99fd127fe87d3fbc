# Writes OUTPUT, a source file that holds page.css and page.js of FOLDER with their digests, which a
# page's Content-Security-Policy names.
function(read_asset file)
  file(READ ${FOLDER}/${file} text)
  file(SHA256 ${FOLDER}/${file} digest)
  # A raw string ends where its delimiter stands.
  string(FIND "${text}" ")page_asset\"" ending)
  if(NOT ending EQUAL -1)
    message(FATAL_ERROR "${file} holds the delimiter of the string that it is put into")
  endif()
  set(asset "{R\"page_asset(${text})page_asset\", \"${digest}\"}" PARENT_SCOPE)
endfunction()

read_asset(page.css)
set(style "${asset}")
read_asset(page.js)
set(script "${asset}")
file(WRITE ${OUTPUT} "#include \"daemon/report/page/page_assets.hpp\"

namespace loopscope::daemon {

PageAsset page_style() {
  return ${style};
}

PageAsset page_script() {
  return ${script};
}

}  // namespace loopscope::daemon
")
