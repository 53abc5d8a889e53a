//! Gives the shared library its soname, which cargo does not.

use std::env::var;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let version = var("CARGO_PKG_VERSION").unwrap();
    let [major, minor] = ["MAJOR", "MINOR"].map(|n| var(format!("CARGO_PKG_VERSION_{n}")).unwrap());
    // Before 1.0 a minor version may break the ABI.
    let abi = if major == "0" {
        format!("0.{minor}")
    } else {
        major
    };
    match var("CARGO_CFG_TARGET_OS").unwrap().as_str() {
        "linux" | "android" | "freebsd" | "netbsd" | "openbsd" => {
            link_arg(&format!("-soname,libperiodyn.so.{abi}"));
        }
        "macos" => {
            link_arg(&format!("-install_name,@rpath/libperiodyn.{abi}.dylib"));
            link_arg(&format!("-compatibility_version,{abi}"));
            link_arg(&format!("-current_version,{version}"));
        }
        _ => {}
    }
}

fn link_arg(arg: &str) {
    println!("cargo::rustc-cdylib-link-arg=-Wl,{arg}");
}
