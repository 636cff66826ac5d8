#!/usr/bin/env bash
# Installs what packages.txt lists and this machine lacks; does nothing, and needs no rights, when all is there.
set -euo pipefail
cd "$(dirname "$0")/.."

# What an installed package provides counts: Node.js from elsewhere brings npm along, and conflicts with Debian's.
provided=$(dpkg-query -W -f='${db:Status-Abbrev} ${Provides}\n' | sed -n 's/^ii *//p' | sed 's/([^)]*)//g' | tr -s ', \n' '\n')
wanted=$(sed 's/#.*//' packages.txt | tr -s '[:space:]' ' ')
missing=()
for package in $wanted; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' ||
    grep -qxF "$package" <<<"$provided" || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  echo "packages: all of packages.txt is installed"
  exit 0
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "packages: ${missing[*]} are missing; run this as root, or install them yourself" >&2
    exit 1
  fi
  as_root=(sudo)
fi
echo "packages: installing ${missing[*]}"
export DEBIAN_FRONTEND=noninteractive
"${as_root[@]}" apt-get -qq update
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -y --no-install-recommends install "${missing[@]}" >/dev/null
