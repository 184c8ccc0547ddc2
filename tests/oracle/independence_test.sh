#!/bin/sh
# Fails if a file of the oracle includes anything but system headers (<...>, not of this project) and its own
# headers. Usage: independence_test.sh [folder of the oracle]
cd "${1:-$(dirname "$0")}" || exit 2
failed=0
refuse() {
    echo "$1: not independent: $2"
    failed=1
}

for file in *.h *.cpp; do
    includes=$(sed -n 's/^[[:space:]]*#[[:space:]]*include[[:space:]]*\(.*\)$/\1/p' "$file")
    while IFS= read -r include; do
        case $include in
        '') ;;
        *..* | *kernel* | *render* | *app/* | *hwmodel* | *voxmelt*) refuse "$file" "$include" ;;
        '<nlohmann/json.hpp>'*) ;;
        '<'*/*) refuse "$file" "$include" ;;
        '<'*.h'>'* | '<'*.hpp'>'*) refuse "$file" "$include" ;;
        '<'*'>'*) ;;
        '"'*/*) refuse "$file" "$include" ;;
        '"'*'"'*)
            name=${include#\"}
            name=${name%%\"*}
            [ -f "$name" ] && [ ! -L "$name" ] || refuse "$file" "$include"
            ;;
        *) refuse "$file" "$include" ;;
        esac
    done <<END
$includes
END
done

# Nor may its CMakeLists.txt name a folder or a target of the project.
if sed 's/#.*//' CMakeLists.txt | grep -nE '\.\./|PROJECT_SOURCE_DIR|CMAKE_SOURCE_DIR|kernel|render|hwmodel'; then
    refuse CMakeLists.txt "the lines above"
fi
# Folders below it would escape the loop above.
for entry in *; do
    [ -d "$entry" ] && refuse "$entry" "a folder"
done
exit $failed
