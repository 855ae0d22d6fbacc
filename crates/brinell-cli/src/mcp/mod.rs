//! `brinell mcp`: the command's own operations as tools of the Model Context Protocol, over standard input and output.
//!
//! A tool is this program again, started in the folder with `--json`: an agent gets the very record that the command prints,
//! one call cannot take the others down, and a call that is cancelled ends with its process. The protocol is the `rmcp` crate's.

mod answer;
mod call;
mod offered;

use crate::failure::{ExitCode, Failure};
use answer::{answer, refused};
use call::Calls;
use clap::Args;
use offered::{OFFERED, Operation};
use rmcp::ServerHandler;
use rmcp::model::{
    CallToolRequestParams, CallToolResponse, ErrorData, Implementation, ListToolsResult, PaginatedRequestParams,
    ServerCapabilities, ServerConfig,
};
use rmcp::service::{RequestContext, RoleServer, ServiceExt};
use std::path::PathBuf;

/// What an agent is told of all tools.
const INSTRUCTIONS: &str = r#"brinell simulates the vibration of rolling bearings with damage, and diagnoses measured signals.
Paths count from the served folder and stay within it. Units are in the keys' names; messages call a key by its option: --rate is rate_hz.
A scenario is a TOML file: `check` says what follows from it and what is wrong with it, `run` simulates it into a folder of results, which `analyze` judges as it judges a measured signal, `sweep` varies its keys. Values that nobody gave are assumptions, which the records list.
Records are long: `only` asks for parts of them; the whole is in the folder of results.
A scenario:
[bearing]
preset = "NU206"
[operation]
speed_rpm = 1800
load_n = [1000, 0]
[[defects]]
on = "outer-raceway"
center_deg = 0
depth_um = 20
shape = { rectangle = { length_mm = 2, width_mm = 4 } }
[simulation]
duration_s = 0.5
"#;

#[derive(Debug, Args)]
#[command(after_help = "An agent starts it by itself, where its configuration has:\n  \
    {\"mcpServers\": {\"brinell\": {\"command\": \"brinell\", \"args\": [\"mcp\", \"FOLDER\"]}}}\n\n\
    Tools: frequencies, check, run, analyze, sweep. Their keys are the commands' options; each answers with the JSON that its command prints \
    with --json. Nothing outside FOLDER is read or written, whatever links, scenarios and paths say; nothing goes over the network.")]
pub(crate) struct McpArgs {
    /// The folder of scenarios, signals and results; paths count from it
    #[arg(value_name = "FOLDER")]
    folder: PathBuf,
}

/// Serves until standard input ends.
pub(crate) fn mcp(command: &clap::Command, args: &McpArgs) -> Result<ExitCode, Failure> {
    let folder = args.folder.canonicalize().map_err(|error| Failure::Read(args.folder.clone(), error))?;
    if !folder.is_dir() {
        return Err(Failure::Usage(format!("{}: a file, expected a folder", args.folder.display())));
    }
    let failed = |words: String| Failure::NotServed(words);
    let calls = Calls::new(folder).map_err(|error| failed(error.to_string()))?;
    let server = Server { calls, operations: OFFERED.iter().filter_map(|offered| offered.of(command)).collect() };
    let runtime = tokio::runtime::Builder::new_current_thread().enable_time().build();
    let runtime = runtime.map_err(|error| failed(error.to_string()))?;
    let served = runtime.block_on(async {
        let service = server.serve((tokio::io::stdin(), tokio::io::stdout())).await;
        let service = service.map_err(|error| failed(error.to_string()))?;
        // Ctrl-C, and who ends this process otherwise, ends the calls too.
        let mut cancel = Some(service.cancellation_token());
        let heard = ctrlc::set_handler(move || {
            if let Some(token) = cancel.take() {
                token.cancel();
            }
        });
        heard.map_err(|error| failed(format!("cannot listen for Ctrl-C: {error}")))?;
        service.waiting().await.map_err(|error| failed(error.to_string()))
    });
    // Ends the processes of calls that nobody waits for any more.
    runtime.shutdown_background();
    served.map(|_| ExitCode::SUCCESS)
}

struct Server {
    calls: Calls,
    operations: Vec<Operation>,
}

impl ServerHandler for Server {
    fn get_info(&self) -> ServerConfig {
        let tools = ServerCapabilities::builder().enable_tools().build();
        ServerConfig::new(tools)
            .with_server_info(Implementation::new("brinell", brinell::VERSION))
            .with_instructions(INSTRUCTIONS)
    }

    async fn list_tools(
        &self,
        _: Option<PaginatedRequestParams>,
        _: RequestContext<RoleServer>,
    ) -> Result<ListToolsResult, ErrorData> {
        Ok(ListToolsResult::with_all_items(self.operations.iter().map(Operation::tool).collect()))
    }

    async fn call_tool(
        &self,
        request: CallToolRequestParams,
        context: RequestContext<RoleServer>,
    ) -> Result<CallToolResponse, ErrorData> {
        let Some(operation) = self.operations.iter().find(|operation| operation.name() == request.name) else {
            let known: Vec<&str> = self.operations.iter().map(Operation::name).collect();
            let words = format!("{}: no such tool; allowed: {}", request.name, known.join(", "));
            return Err(ErrorData::invalid_params(words, None));
        };
        let asked = match operation.asked(&request.arguments.unwrap_or_default()) {
            Ok(asked) => asked,
            Err(words) => return Ok(refused(format!("error: {words}")).into()),
        };
        let ended = tokio::select! {
            () = context.ct.cancelled() => return Ok(refused("cancelled".into()).into()),
            ended = self.calls.call(&asked.words) => ended,
        };
        Ok(ended.map_or_else(|error| refused(format!("error: {error}")), |ended| answer(&ended, &asked.only)).into())
    }
}
