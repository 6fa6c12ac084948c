//! Law: the scripts of docs/proofs are those of the kernels as they are, and of the bounds as they are documented.

mod proofs;

#[test]
fn scripts_are_those_of_the_kernels() {
    for (name, script) in proofs::scripts() {
        let kept = std::fs::read_to_string(format!("{}/docs/proofs/{name}", env!("CARGO_MANIFEST_DIR")));
        assert!(kept.is_ok_and(|kept| kept == script), "{name} is old: cargo run --example proofs -- docs/proofs");
    }
}
