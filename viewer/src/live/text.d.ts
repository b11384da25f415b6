/** Files that the build puts into the script as text. */
declare module "*.toml" {
  const text: string;
  export default text;
}
