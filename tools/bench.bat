@ECHO OFF
REM Measures DEMO.EXE on this machine. Each run appends a line to a file of
REM comma-separated values; the first column tells the switches.
REM
REM     BENCH [FILE [SECONDS]]      default: RESULTS.CSV, 60 seconds a run
REM
REM The minute of the 1998 report is the second run, its own methods the third.

SET FBFILE=RESULTS.CSV
SET FBTIME=60
IF NOT "%1"=="" SET FBFILE=%1
IF NOT "%2"=="" SET FBTIME=%2
ECHO Eight runs of %FBTIME% seconds, results in %FBFILE%. ESC skips one.

REM In colour; monochrome; as in 1998; without the copy to the card.
DEMO /T:%FBTIME% /O:%FBFILE%
IF ERRORLEVEL 1 GOTO TROUBLE
DEMO /G /T:%FBTIME% /O:%FBFILE%
IF ERRORLEVEL 1 GOTO TROUBLE
DEMO /G /P /T:%FBTIME% /O:%FBFILE%
IF ERRORLEVEL 1 GOTO TROUBLE
DEMO /G /X /T:%FBTIME% /O:%FBFILE%
IF ERRORLEVEL 1 GOTO TROUBLE

REM At the pace of the screen; coarser and finer.
DEMO /G /V /T:%FBTIME% /O:%FBFILE%
IF ERRORLEVEL 1 GOTO TROUBLE
DEMO /G /S:4 /T:%FBTIME% /O:%FBFILE%
IF ERRORLEVEL 1 GOTO TROUBLE
DEMO /G /S:1 /T:%FBTIME% /O:%FBFILE%
IF ERRORLEVEL 1 GOTO TROUBLE
DEMO /G /S:0.5 /T:%FBTIME% /O:%FBFILE%
IF ERRORLEVEL 1 GOTO TROUBLE
TYPE %FBFILE%
GOTO END

:TROUBLE
ECHO The benchmark has stopped early.
:END
SET FBFILE=
SET FBTIME=
