# NOT TRIED: written after the documentation alone. Has Recollect started when a user signs in, and again when it ends
# otherwise than by being left. Run as an administrator:
#   powershell -ExecutionPolicy Bypass -File supervise.ps1 -User BOOTH -Study FILE [-Program PATH] [-Remove]
param(
    [Parameter(Mandatory = $true)][string]$User,
    [string]$Study,
    [string]$Program = "$env:ProgramFiles\Recollect\recollect.exe",
    [switch]$Remove
)
$ErrorActionPreference = "Stop"
$name = "Recollect for $User"

if ($Remove) {
    Unregister-ScheduledTask -TaskName $name -Confirm:$false
    Write-Output "$name is removed."
    exit 0
}
if (-not (Test-Path $Program)) {
    Write-Error "There is no $Program; copy the built folder there first."
    exit 2
}
if (-not $Study -or -not (Test-Path $Study)) {
    Write-Error "Name the study file with -Study; it needs a PIN."
    exit 2
}

$action = New-ScheduledTaskAction -Execute $Program -Argument "run --supervise --study `"$Study`""
$trigger = New-ScheduledTaskTrigger -AtLogOn -User $User
# An exit code that is not 0 is a failure to the scheduler, which starts the task again after a minute, the shortest
# time that it knows; within that minute the supervisor itself has long started the kiosk again.
$settings = New-ScheduledTaskSettingsSet -RestartCount 999 -RestartInterval (New-TimeSpan -Minutes 1) `
    -ExecutionTimeLimit ([TimeSpan]::Zero) -AllowStartIfOnBatteries -DontStopIfGoingOnBatteries `
    -MultipleInstances IgnoreNew
$principal = New-ScheduledTaskPrincipal -UserId $User -LogonType Interactive -RunLevel Limited
Register-ScheduledTask -TaskName $name -Action $action -Trigger $trigger -Settings $settings -Principal $principal `
    -Force | Out-Null
Write-Output "$name starts when $User signs in."
